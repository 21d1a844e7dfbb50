"""What each peer is given and what it prints: the arguments of `vitriol bench --against`, one JSON object on standard output.

Lengths in m, times in s unless a name says otherwise.
"""

import argparse
import json
import math
import os
import sys
import time

# Simulated time before the first measured frame, and frames that are queued before the clock is read: as in `vitriol bench`.
WARM_UP = 1.0
QUEUED = 8


def arguments(what):
    parser = argparse.ArgumentParser(description=what)
    parser.add_argument("--particles", type=int, default=13_894)
    parser.add_argument("--substeps", type=int, default=3, help="in a frame")
    parser.add_argument("--iterations", type=int, default=2, help="in a substep")
    parser.add_argument("--spacing", type=float, default=0.05, help="between particles at rest, m; half of the support radius")
    parser.add_argument("--depth", type=float, help="of the liquid, m; without it that of a cube")
    parser.add_argument("--frame-time", type=float, default=1 / 60, help="simulated, s")
    parser.add_argument("--gravity", type=float, default=9.81, help="m/s²")
    parser.add_argument("--viscosity", type=float, default=0.3, help="XSPH's coefficient in a substep")
    parser.add_argument("--frames", type=int, default=96, help="to measure")
    parser.add_argument("--arch", default="gpu", help="gpu (CUDA, else Vulkan), cuda, vulkan or cpu")
    return parser


def lattice(args):
    """Positions of a block at rest from the bottom up, and the box that it fills to its top: (n, 3), (width, depth)."""
    import numpy as np

    n, d = args.particles, args.spacing
    layers = max(1, round(args.depth / d if args.depth else n ** (1 / 3)))
    in_layer = math.ceil(n / layers)
    across = math.ceil(math.sqrt(in_layer))
    along = math.ceil(in_layer / across)
    index = np.arange(n)
    layer, place = index // (across * along), index % (across * along)
    # The sites of the last layer that are used are spread over all of it.
    last = layer == layer.max()
    place[last] = np.arange(last.sum()) * (across * along) // last.sum()
    sites = np.stack([place % across, layer, place // across], -1) + 0.5
    # Breaks the lattice's symmetry and leaves its density.
    jitter = np.random.default_rng(0).uniform(-1e-3, 1e-3, sites.shape)
    return ((sites + jitter) * d).astype(np.float32), (across * d, along * d)


def spline(q):
    """The cubic spline over its value at 0, q = r/h."""
    import numpy as np

    return 2.0 * np.maximum(1.0 - q, 0.0) ** 3 - 8.0 * np.maximum(0.5 - q, 0.0) ** 3


def beyond(q):
    """Share of the kernel beyond a plane at the distance q = s/h."""
    import numpy as np

    q = np.maximum(q, 0.0)
    a = np.maximum(1.0 - q, 0.0)
    near = 0.5 - 1.4 * q + 8.0 / 3.0 * q**3 - 4.8 * q**5 + 3.2 * q**6
    return np.where(q < 0.5, near, 1.6 * a**5 - 16.0 / 15.0 * a**6)


def densities(positions, size, d):
    """Each particle's density over the rest density: the sum over neighbours, and what floor and walls hold of the kernel."""
    import numpy as np

    h = 2.0 * d
    cells = np.floor((positions - positions.min(0)) / h).astype(np.int64) + 1
    shape = cells.max(0) + 2
    key = np.ravel_multi_index(cells.T, shape)
    order = np.argsort(key, kind="stable")
    x, key = positions[order], key[order]
    sums = np.ones(len(x))
    # In sorted order the n-th neighbour of all particles that have one in a cell is looked at at once.
    for step in np.ndindex(3, 3, 3):
        other = key + np.ravel_multi_index(step, shape) - np.ravel_multi_index((1, 1, 1), shape)
        first, last = np.searchsorted(key, other, "left"), np.searchsorted(key, other, "right")
        for n in range(int((last - first).max())):
            i = np.flatnonzero(first + n < last)
            j = first[i] + n
            i, j = i[i != j], j[i != j]
            np.add.at(sums, i, spline(np.linalg.norm(x[i] - x[j], axis=-1) / h))
    free = np.ones(len(x))
    for axis, length in ((0, size[0]), (2, size[1])):
        free *= 1.0 - beyond(x[:, axis] / h) - beyond((length - x[:, axis]) / h)
    free *= 1.0 - beyond(x[:, 1] / h)
    ratios = np.empty(len(x))
    ratios[order] = sums / math.pi + 1.0 - free
    return ratios


def rank(values, share):
    """The nearest rank, so always a value that was measured."""
    values = sorted(values)
    return values[max(0, min(len(values) - 1, math.ceil(share * len(values)) - 1))]


def timed(args, frame, wait):
    """A frame's share, ms, of QUEUED frames that are waited for once, as often as it takes for `args.frames`."""
    times = []
    for _ in range(math.ceil(args.frames / QUEUED)):
        wait()
        begin = time.perf_counter()
        for _ in range(QUEUED):
            frame()
        wait()
        times.append((time.perf_counter() - begin) * 1e3 / QUEUED)
    return times


def report(args, name, version, device, times, ratios, **more):
    """Prints the result; `ratios` are all particles' densities over the rest density."""
    import numpy as np

    errors = np.maximum(np.asarray(ratios, np.float64) - 1.0, 0.0)
    if not np.all(np.isfinite(errors)):
        sys.exit(f"{name}: some densities are no numbers: take more substeps")
    found = {
        "name": name,
        "version": version,
        "device": device,
        "particles": args.particles,
        "substeps": args.substeps,
        "iterations": args.iterations,
        # What Vitriol reads; the four below are for people.
        "times_ms": times,
        "median_ms": rank(times, 0.5),
        "p95_ms": rank(times, 0.95),
        "least_ms": min(times),
        "greatest_ms": max(times),
        "density_error_mean": float(errors.mean()),
        "density_error_p99": rank(errors.tolist(), 0.99),
        **more,
    }
    print(json.dumps(found))


def processor():
    """The processor's name and how many of its threads there are for us."""
    name = "processor"
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as lines:
            name = next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), name)
    except OSError:
        pass
    return f"{name}, {len(os.sched_getaffinity(0)) if hasattr(os, 'sched_getaffinity') else os.cpu_count()} threads"
