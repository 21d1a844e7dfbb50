"""A still's picture by paths: rays through a crop's pixels, many a pixel, and what they bring on the whole."""

from dataclasses import dataclass

import drjit as dr
import mitsuba as mi
import numpy as np

from tools import vector

# Rays at a time.
WAVE = 1 << 21
# Samples a pixel where no glass or liquid is near.
FEW = 8
# How near is near: further than FLIP's filters reach, pixels.
MARGIN = 8
# Of so many samples one more is taken of what the first surface mirrors.
MIRROR_SHARE = 4


@dataclass
class Still:
    """Linear light by rows, and the shares of each pixel that show glass or liquid, and liquid; the share of rays that were
    given up."""

    light: np.ndarray
    covered: np.ndarray
    wet: np.ndarray
    lost: float


def random_numbers(count, seed):
    return mi.PCG32(size=count, initstate=seed, initseq=dr.arange(mi.UInt64, count))


def rays(camera, pixels, each, rng):
    """`each` rays for each of the crop's pixels that are listed."""
    index = dr.gather(mi.UInt32, mi.UInt32(pixels), dr.arange(mi.UInt32, len(pixels) * each) // each)
    column, row = mi.Float(index % camera.side), mi.Float(index // camera.side)
    right, up, forward = (vector(axis) for axis in camera.axes())
    across = (column + rng.next_float32() - 0.5 * camera.side) / camera.focal
    down = (row + rng.next_float32() - 0.5 * camera.side) / camera.focal
    way = dr.normalize(forward + across * right - down * up)
    return mi.Point3f(vector(camera.eye)) + dr.zeros(mi.Point3f, len(pixels) * each), way


def means(paths, camera, pixels, samples, seed, first):
    """Means over `samples` for each listed pixel: light, covered, wet, given up."""
    count = len(pixels)
    sums = np.zeros((count, 6))
    done = 0
    while done < samples:
        each = max(min(samples - done, WAVE // count), 1)
        rng = random_numbers(count * each, seed * 65536 + done)
        origin, way = rays(camera, pixels, each, rng)
        light, covered, wet, lost = paths.seen(origin, way, rng, first)
        light = dr.select(dr.isfinite(light), light, 0.0)
        dr.eval(light, covered, wet, lost)
        parts = [*(np.array(channel) for channel in light), np.array(covered), np.array(wet), np.array(lost)]
        sums += np.stack(parts, -1).reshape(count, each, 6).sum(1)
        done += each
    return sums / samples


def both(paths, camera, pixels, samples, seed):
    """The same of all light, that which the first surface mirrors and that which it lets pass."""
    found = means(paths, camera, pixels, samples, seed, 0)
    if paths.options.mirrors:
        mirrored = means(paths, camera, pixels, max(samples // MIRROR_SHARE, 2), seed + 32768, 1)
        found[:, :3] += mirrored[:, :3]
    return found


def near(mask):
    """Pixels that have one of the mask within MARGIN along rows and columns."""
    wide = mask.copy()
    for axis in (0, 1):
        padded = np.pad(wide, [(MARGIN, MARGIN) if n == axis else (0, 0) for n in (0, 1)])
        shifts = [np.take(padded, np.arange(wide.shape[axis]) + n, axis) for n in range(2 * MARGIN + 1)]
        wide = np.any(shifts, 0)
    return wide


def render(paths, camera, samples, seed):
    """The still, of so many samples a pixel where glass or liquid is near."""
    side = camera.side
    every = np.arange(side * side, dtype=np.uint32)
    found = both(paths, camera, every, min(samples, FEW), seed)
    if samples > FEW:
        pixels = every[near((found[:, 3] > 0.0).reshape(side, side)).ravel()]
        if len(pixels):
            found[pixels] = both(paths, camera, pixels, samples, seed + 16384)
    light, covered, wet = found[:, :3], found[:, 3], found[:, 4]
    return Still(
        light.reshape(side, side, 3),
        covered.reshape(side, side),
        wet.reshape(side, side),
        float(found[:, 5].mean()),
    )
