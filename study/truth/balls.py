"""Bubbles and drops as one mesh of balls each, and the files that list them."""

import re
from pathlib import Path

import mitsuba as mi
import numpy as np

# Halvings of an icosahedron's edges: 1280 faces a ball, that lie within 0.5 % of its radius.
HALVINGS = 3
# From drop to drop of a jet, in their radii, and most drops of a flight: as `shaders/wgsl/common/picture/spray_drops.wgsl` says, with its
# source.
JET_STEP = 4.77
MOST_DROPS = 8
# Finer drops are not seen: 20 µm are a twentieth of a pixel at half a metre.
LEAST_DROP = 2e-5


def cloud(file):
    """The columns of a PLY file of points alone, by name."""
    data = Path(file).read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:end].decode()
    names = re.findall(r"^property float (\w+)$", header, re.M)
    count = int(re.search(r"^element vertex (\d+)$", header, re.M).group(1))
    values = np.frombuffer(data[end:], "<f4").reshape(count, len(names)).astype(np.float64)
    return {name: values[:, n] for n, name in enumerate(names)}


def icosphere(halvings=HALVINGS):
    """Corners of length 1 and faces, counter-clockwise from outside."""
    golden = 0.5 * (1.0 + np.sqrt(5.0))
    flat = [(-1, golden, 0), (1, golden, 0), (-1, -golden, 0), (1, -golden, 0)]
    corners = np.array([np.roll(corner, turn) for turn in range(3) for corner in flat], float)
    # Neighbours are 2 apart.
    near = np.isclose(np.linalg.norm(corners[:, None] - corners[None], axis=-1), 2.0)
    count = len(corners)
    faces = [(a, b, c) for a in range(count) for b in range(a) for c in range(b) if near[a, b] and near[b, c] and near[a, c]]
    corners = list(corners / np.linalg.norm(corners[0]))
    for _ in range(halvings):
        middles, finer = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                place = corners[a] + corners[b]
                middles[key] = len(corners)
                corners.append(place / np.linalg.norm(place))
            return middles[key]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = finer
    corners, faces = np.array(corners), np.array(faces)
    # Turned out of the axes: a ray just along an edge may miss the faces on both of its sides.
    for angle in (0.3, 0.7):
        cosine, sine = np.cos(angle), np.sin(angle)
        corners = np.roll(corners @ np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]]), 1, axis=1)
    a, b, c = (corners[faces[:, n]] for n in range(3))
    inward = np.sum(np.cross(b - a, c - a) * a, -1) < 0.0
    faces[inward] = faces[inward][:, ::-1]
    return corners, faces


def balls(name, centres, radii, halvings=HALVINGS):
    """A mesh of all of them, with the balls' own normals and volumes."""
    corners, faces = icosphere(halvings)
    a, b, c = (corners[faces[:, n]] for n in range(3))
    volume = np.sum(np.cross(a, b) * c) / 6.0
    fuller = np.cbrt(4.0 / 3.0 * np.pi / volume)
    places = centres[:, None] + fuller * np.asarray(radii)[:, None, None] * corners
    numbers = faces[None] + len(corners) * np.arange(len(centres))[:, None, None]
    mesh = mi.Mesh(name, places.size // 3, numbers.size // 3, has_vertex_normals=True)
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = mi.Float(places.ravel().astype(np.float32))
    parameters["vertex_normals"] = mi.Float(np.tile(corners, (len(centres), 1)).ravel().astype(np.float32))
    parameters["faces"] = mi.UInt32(numbers.ravel().astype(np.uint32))
    parameters.update()
    return mesh


def bubbles(file):
    """Those of `bubbles-N.ply` as a mesh; None for none."""
    found = cloud(file)
    places = np.stack([found[axis] for axis in "xyz"], -1)
    return balls("air_bubble", places, found["radius"]) if len(places) else None


def spray(file):
    """Drops of `spray-N.ply` as a mesh; None for none. A jet's are behind one another, others lie about."""
    found = cloud(file)
    random = np.random.default_rng(1)
    places, radii = [], []
    for n, radius in enumerate(found["radius"]):
        if radius < LEAST_DROP:
            continue
        first = np.array([found[axis][n] for axis in "xyz"])
        velocity = np.array([found[axis][n] for axis in ("vx", "vy", "vz")])
        speed = np.linalg.norm(velocity)
        back = -JET_STEP * radius * velocity / speed if speed > 0.0 else np.zeros(3)
        reach = found["about"][n]
        for k in range(min(max(int(found["drops"][n] + 0.5), 1), MOST_DROPS)):
            aside = reach * random.uniform(-1.0, 1.0, 3) if reach > 0.0 else k * back
            places.append(first + aside)
            radii.append(radius)
    return balls("spray", np.array(places), radii, 2) if places else None
