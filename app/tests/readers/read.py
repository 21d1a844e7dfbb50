"""Reads what `vitriol export` wrote with the programs that it is for, and prints what they found as JSON."""

import csv
import glob
import json
import math
import os
import re
import subprocess
import sys
import tempfile

import jsonschema
import matplotlib
import meshio
import numpy
import pyarrow.parquet
import pyvista
import rerun

folder, report, schema = sys.argv[1:4]


def path(name):
    return os.path.join(folder, name)


def flux(mesh, origin):
    """A third of the integral of x.n: the volume within, of a closed surface."""
    faces = mesh.faces.reshape(-1, 4)[:, 1:]
    at = mesh.points.astype(float) - origin
    a, b, c = (at[faces[:, k]] for k in range(3))
    return float(numpy.einsum("ij,ij->i", a, numpy.cross(b, c)).sum() / 6)


def particles():
    series = json.load(open(path("particles.vtu.series")))
    reader = pyvista.get_reader(path("particles.vtu.series"))
    last = pyvista.read(path(series["files"][-1]["name"]))
    return {
        "times": [entry["time"] for entry in series["files"]],
        "series_times": list(reader.time_values),
        "own_time": float(last.field_data["TimeValue"][0]),
        "count": last.n_points,
        "cells": last.n_cells,
        # Cell n is the vertex of point n alone.
        "vertices": bool((last.cell_connectivity == numpy.arange(last.n_points)).all()
                         and (last.offset == numpy.arange(last.n_points + 1)).all()),
        "names": sorted(last.point_data.keys()),
        "mass_kg": float(last.point_data["mass_kg"].sum()),
        "volume_m3": float(last.point_data["volume_m3"].sum()),
        "temperature_mean": float(
            numpy.average(last.point_data["temperature_degC"], weights=last.point_data["mass_kg"])
        ),
        "lowest": last.points.min(axis=0).tolist(),
        "highest": last.points.max(axis=0).tolist(),
    }, last.points


def surfaces():
    number = sorted(glob.glob(path("air-liquid-*.ply")))[-1][-10:-4]
    names = ["air-liquid", "glass-liquid", "air-glass"]
    meshes = {name: pyvista.read(path(f"{name}-{number}.ply")) for name in names}
    origin = meshes["air-glass"].points.mean(axis=0).astype(float)
    flows = {name: flux(mesh, origin) for name, mesh in meshes.items()}
    normals = meshes["air-liquid"].point_data["Normals"]
    return {
        "liquid_m3": flows["air-liquid"] - flows["glass-liquid"],
        "glass_m3": flows["air-glass"] + flows["glass-liquid"],
        "unit_normals": bool(numpy.allclose(numpy.linalg.norm(normals, axis=1), 1, atol=1e-4)),
        "table_height": float(pyvista.read(path("table.ply")).points[:, 1].max()),
        "cameras": [camera["name"] for camera in json.load(open(path(f"cameras-{number}.json")))["cameras"]],
    }


def tables():
    rows = list(csv.reader(open(path("measurements.csv"), newline="")))
    parquet = pyarrow.parquet.read_table(path("measurements.parquet"))
    head, cells = rows[0], rows[1:]
    same = head == parquet.column_names and len(cells) == parquet.num_rows
    for index, name in enumerate(parquet.column_names):
        for row, value in zip(cells, parquet.column(index).to_pylist()):
            cell = float(row[index]) if row[index] else None
            same = same and cell == value
    return {
        "head": head,
        "same": same,
        "times": [float(row[0]) for row in cells],
        "mass_kg": [
            sum(float(row[k]) for k, name in enumerate(head) if name.startswith("mass in ") or name.startswith("mass on "))
            for row in cells
        ],
    }


def conversions():
    """What meshio keeps of the particles in its other formats, whose names may have no spaces."""
    last = sorted(glob.glob(path("particles-*.vtu")))[-1]
    expected = pyvista.read(last).point_data
    scalars = [name for name in expected.keys() if expected[name].ndim == 1]
    mesh = meshio.read(last)
    kept = {}
    for ending in ["vtu", "vtk", "ply"]:
        read = mesh
        if ending != "vtu":
            with tempfile.TemporaryDirectory() as there:
                file = os.path.join(there, f"particles.{ending}")
                mesh.write(file)
                read = meshio.read(file)
        kept[ending] = sorted(
            name for name in scalars
            if name in read.point_data and numpy.array_equal(read.point_data[name], expected[name])
        )
    return {"scalars": sorted(scalars), "kept": kept}


def recording(points):
    rrd = path("recording.rrd")
    program = os.path.join(os.path.dirname(sys.executable), "rerun")
    quiet = dict(stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    subprocess.run([program, "mcap", "convert", path("recording.mcap"), "-o", rrd], check=True, **quiet)
    checked = subprocess.run([program, "mcap", "check", path("recording.mcap"), "--full"], capture_output=True, text=True)
    server = rerun.server.Server(datasets={"recording": [os.path.abspath(rrd)]})
    dataset = server.client().get_dataset("recording")

    def rows(entity, component):
        view = dataset.filter_contents([entity]).reader(index="message_log_time")
        table = view.to_arrow_table()
        times = table.column("message_log_time").cast("int64").to_pylist()
        pairs = zip(times, table.column(f"{entity}:{component}").to_pylist())
        return [(time, value) for time, value in pairs if value]

    clouds = rows("/particles", "Points3D:positions")
    last = numpy.array(clouds[-1][1])
    packed = numpy.array(rows("/particles", "Points3D:colors")[-1][1], dtype="u4")
    colours = numpy.stack([packed >> shift & 255 for shift in (24, 16, 8, 0)], axis=1) / 255
    plasma = matplotlib.colormaps["plasma"](numpy.linspace(0, 1, 256))
    aside = [float(numpy.abs(plasma - colour).max(axis=1).min()) for colour in numpy.unique(colours, axis=0)]
    samples = rows("/film", "VideoStream:sample")
    measured = rows("/measurements", "vitriol.Measurements:message")
    cells = [
        [float(cell) if cell else math.nan for cell in row]
        for row in list(csv.reader(open(path("measurements.csv"), newline="")))[1:]
    ]
    # All of a moment: the table has the last of each alone.
    frames = set()
    for entity in ["/tf", "/flasks"]:
        printed = subprocess.run([program, "rrd", "print", "-vvv", "--entity", entity, rrd], capture_output=True, text=True)
        frames.update(re.findall(r"\[([a-z_0-9]+)\]", printed.stdout))
    return {
        "check": checked.returncode,
        "cloud_times_ns": [time for time, _ in clouds],
        "colours": len(colours),
        "aside_of_plasma": max(aside),
        "measurement_times_ns": [time for time, _ in measured],
        "measurements_are_the_table": numpy.array_equal(
            [list(message[0].values()) for _, message in measured], cells, equal_nan=True
        ),
        "flask_times_ns": [time for time, _ in rows("/flasks", "Transform3D:child_frame")],
        "same_points": bool(last.shape == points.shape and numpy.array_equal(last.astype("f4"), points)),
        "film": len(samples),
        "film_begins": bytes(numpy.array(samples[0][1], dtype="u1").ravel()[:5].tolist()).hex(),
        "frames": sorted(frames),
        "inputs": len(rows("/xr/input/left", "vitriol.xr.Input:message")),
    }


def report_is_valid():
    jsonschema.validate(json.load(open(report)), json.load(open(schema)))
    broken = json.load(open(report))
    broken["mass_kg"]["table"] = "much"
    try:
        jsonschema.validate(broken, json.load(open(schema)))
    except jsonschema.ValidationError:
        return True
    return False


found, points = particles()
print(
    json.dumps(
        {
            "particles": found,
            "surfaces": surfaces(),
            "tables": tables(),
            "recording": recording(points),
            "conversions": conversions(),
            "report_is_valid": report_is_valid(),
        },
        allow_nan=False,
    )
)
