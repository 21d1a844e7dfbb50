"""What a still consists of: files of `vitriol export` as a Mitsuba scene, the room's boxes, the acid in the liquid."""

import re
from dataclasses import dataclass, field
from pathlib import Path

import mitsuba as mi
import numpy as np

import balls

# How much lower the bench is taken to be, m. Glass stands in its very plane, and a ray would meet either first; real glass
# stands on a few points, with air between.
GAP = 5e-5


@dataclass
class Camera:
    """A square crop about a picture's middle. `focal` in pixels; places in m."""

    eye: np.ndarray
    target: np.ndarray
    focal: float
    side: int

    def axes(self):
        """To the right, up and forward, as `View::look_at` of `render/src/camera.rs` has them."""
        back = self.eye - self.target
        back = back / np.linalg.norm(back)
        right = np.cross([0.0, 1.0, 0.0], back)
        right = right / np.linalg.norm(right)
        return right, np.cross(back, right), -back


@dataclass
class Bench:
    """`shapes` by name are Mitsuba's; boxes are (low, high) corners in m."""

    scene: object = None
    shapes: dict = field(default_factory=dict)
    room: tuple = None
    table: tuple = None
    # Mass fraction of acid on a grid, its low corner and the cells' edge, or None for water alone.
    acid: tuple = None


def load(folder):
    """The one moment that a folder has."""
    folder = Path(folder)
    bench = Bench()
    description = {"type": "scene"}
    for name in ("air-liquid", "glass-liquid", "air-glass"):
        mesh = mi.load_dict({"type": "ply", "filename": str(next(folder.glob(f"{name}-*.ply")))})
        if mesh.face_count():
            description[name.replace("-", "_")] = mesh
    # Files of before there were such have none.
    for name, key, of in (("bubbles", "air_bubble", balls.bubbles), ("spray", "spray", balls.spray)):
        meshes = (of(file) for file in folder.glob(f"{name}-*.ply"))
        description.update({key: mesh for mesh in meshes if mesh is not None})
    bench.table = box(folder / "table.ply", GAP)
    bench.room = box(folder / "room.ply", 0.0)
    low, high = bench.room
    bench.room = (low - [0, GAP, 0], high)
    description["table"] = cube(*bench.table)
    finish(bench, description)
    particles = list(folder.glob("particles-*.vtu"))
    if particles:
        bench.acid = acid_grid(*vtu(particles[0]))
    return bench


def finish(bench, description):
    """Builds the scene; shapes are known by their keys."""
    bench.scene = mi.load_dict(description)
    bench.shapes = {shape.id(): shape for shape in bench.scene.shapes()}
    names = [name for name, value in description.items() if name != "type"]
    if not set(names) <= set(bench.shapes):
        bench.shapes = dict(zip(names, bench.scene.shapes()))


def box(file, lower):
    """The corners of a mesh that is a box, its top so much lower."""
    bounds = mi.load_dict({"type": "ply", "filename": str(file)}).bbox()
    low, high = np.array(bounds.min).ravel(), np.array(bounds.max).ravel()
    return low - [0, lower, 0], high - [0, lower, 0]


def cube(low, high):
    """A box as a shape of Mitsuba."""
    to_world = mi.ScalarTransform4f().translate(0.5 * (low + high)).scale(0.5 * (high - low))
    return {"type": "cube", "to_world": to_world}


def vtu(file):
    """Positions (m) and mass fractions of acid of `particles-N.vtu`; None for the latter where no heat is modelled."""
    data = Path(file).read_bytes()
    start = data.index(b'<AppendedData encoding="raw">')
    start = data.index(b"_", start) + 1
    arrays = {}
    for tag in re.findall(rb"<DataArray [^>]*>", data[:start]):
        values = dict(re.findall(r'(\w+)="([^"]*)"', tag.decode()))
        if values.get("format") == "appended":
            at = start + int(values["offset"])
            size = int(np.frombuffer(data[at : at + 8], "<u8")[0])
            kind = {"Float32": "<f4", "Float64": "<f8", "UInt32": "<u4", "Int32": "<i4", "Int64": "<i8", "UInt8": "u1"}
            arrays[values["Name"]] = np.frombuffer(data[at + 8 : at + 8 + size], kind[values["type"]])
    return arrays["Points"].reshape(-1, 3), arrays.get("acid_kg_per_kg"), arrays["volume_m3"]


def acid_grid(positions, acid, volumes):
    """Means over particles about each place of a grid, with kernels that end two spacings away."""
    if acid is None or not np.any(acid > 0.0):
        return None
    spacing = float(np.cbrt(np.median(volumes)))
    low = positions.min(0) - 3 * spacing
    shape = np.ceil((positions.max(0) + 3 * spacing - low) / spacing).astype(int) + 1
    sums = np.zeros((*shape, 2))
    nearest = np.rint((positions - low) / spacing).astype(int)
    for x, y, z in np.ndindex(5, 5, 5):
        at = nearest + [x - 2, y - 2, z - 2]
        way = (low + at * spacing - positions) / (2 * spacing)
        weight = np.maximum(1.0 - np.sum(way * way, -1), 0.0) ** 3
        np.add.at(sums, tuple(at.T), np.stack([weight * acid, weight], -1))
    share = np.where(sums[..., 1] > 0, sums[..., 0] / np.maximum(sums[..., 1], 1e-9), 0.0)
    return share.astype(np.float32), low, spacing
