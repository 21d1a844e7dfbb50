"""SPlisHSPlasH's Position Based Fluids on the processor, at rest in a box: a peer for `vitriol bench --against`.

    pip install -r study/peers/requirements.txt
    vitriol bench --against study/peers/splishsplash_pbf.py

Its neighbours are within two spacings as ours are, its walls are of particles (Akinci et al. 2012), and it looks for neighbours
in every substep.
"""

import ctypes
import importlib.metadata
import itertools
import json
import math
import os
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import peer

# Its numbers for Position Based Fluids, for walls of particles, and for a substep of one length.
PBF, PARTICLES, FIXED = 2, 0, 0


def imported():
    """The module. Its wheel brings parts of OpenGL; beside the system's own it crashes unless that comes first."""
    # Threads that wait by spinning take the processor from those that work where something else runs too: half the time, or a tenth.
    os.environ.setdefault("OMP_WAIT_POLICY", "passive")
    try:
        ctypes.CDLL("libGL.so.1", mode=ctypes.RTLD_GLOBAL)
        import pysplishsplash
    except (ImportError, OSError) as error:
        sys.exit(f"SPlisHSPlasH cannot be loaded: {error}; install pysplishsplash, and libgl1 and libx11-6 of Debian")
    return pysplishsplash


def box(path):
    """A cube of edge 1 about the origin, as triangles."""
    corners = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]
    sides = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
    lines = ["v {} {} {}".format(*corner) for corner in corners]
    lines += [f"f {a} {b} {c}\nf {a} {c} {d}" for a, b, c, d in sides]
    path.write_text("\n".join(lines) + "\n")


def points(path, positions):
    """Houdini's BGEO with positions alone."""
    header = np.array([5, len(positions), 0, 0, 0, 0, 0, 0, 0], ">i4").tobytes()
    body = np.c_[positions, np.ones(len(positions))].astype(">f4").tobytes()
    path.write_bytes(b"BgeoV" + header + body + b"\x00\xff")


def scene(args, folder, positions, size):
    """Writes the scene's files; the path of the one that names the others."""
    d = args.spacing
    width, depth = size
    height = 1.5 * float(positions[:, 1].max()) + 4 * d
    box(folder / "box.obj")
    points(folder / "liquid.bgeo", positions)
    # Particles at rest are a spacing from those of a wall.
    extent = [width + d, height + d, depth + d]
    walls = {
        "geometryFile": str(folder / "box.obj"),
        "translation": [0.5 * width, 0.5 * height, 0.5 * depth],
        "scale": extent,
        "isDynamic": False,
        "isWall": True,
    }
    settings = {
        "particleRadius": 0.5 * d,
        "simulationMethod": PBF,
        "boundaryHandlingMethod": PARTICLES,
        "gravitation": [0.0, -args.gravity, 0.0],
        "cflMethod": FIXED,
        "timeStepSize": args.frame_time / args.substeps,
        "enableZSort": True,
    }
    whole = {
        "Configuration": settings,
        "Materials": [{"id": "Fluid", "density0": 1000.0, "xsph": args.viscosity, "xsphBoundary": args.viscosity}],
        "RigidBodies": [walls],
        "FluidModels": [{"id": "Fluid", "particleFile": str(folder / "liquid.bgeo")}],
    }
    path = folder / "scene.json"
    path.write_text(json.dumps(whole))
    return path


def main():
    args = peer.arguments(__doc__.splitlines()[0]).parse_args()
    splish = imported()
    positions, size = peer.lattice(args)
    before = math.ceil(peer.WARM_UP / args.frame_time) * args.substeps
    group, groups = peer.QUEUED * args.substeps, math.ceil(args.frames / peer.QUEUED)
    steps, marks = 0, []

    def stepped():
        nonlocal steps
        steps += 1
        if steps >= before and (steps - before) % group == 0 and len(marks) <= groups:
            marks.append(time.perf_counter())

    with tempfile.TemporaryDirectory() as folder:
        file = scene(args, Path(folder), positions, size)
        base = splish.Exec.SimulatorBase()
        base.init(sceneFile=str(file), useCache=False, outputDir=folder, initialPause=False, useGui=False)
        base.setTimeStepCB(stepped)
        base.initSimulation()
        # Single steps crash: only a run initialises the walls. It ends by simulated time; one substep more does no harm.
        base.setValueFloat(base.STOP_AT, (before + groups * group + 0.5) * args.frame_time / args.substeps)
        simulation = splish.Simulation.getCurrent()
        # What the scene says of these is not taken over.
        step = simulation.getTimeStep()
        step.setValueUInt(step.MIN_ITERATIONS, args.iterations)
        step.setValueUInt(step.MAX_ITERATIONS, args.iterations)
        base.runSimulation()
        method, liquid = simulation.getTimeStep().getMethodName(), simulation.getFluidModel(0)
        if method != "PBF" or liquid.numActiveParticles() != args.particles or len(marks) != groups + 1:
            sys.exit(
                f"it took {steps} steps of {method} and {liquid.numActiveParticles()} particles, which is not what it was told"
            )
        found = np.array([liquid.getPosition(i) for i in range(args.particles)], np.float64)
        speeds = np.array([liquid.getVelocity(i) for i in range(args.particles)], np.float64)
    times = [1e3 * (last - first) / peer.QUEUED for first, last in itertools.pairwise(marks)]
    more = {"rms_speed_m_s": float(np.sqrt((speeds**2).sum(-1).mean())), "top_m": float(found[:, 1].max())}
    # Of its own last iteration, with its walls as it sees them.
    own = np.maximum([liquid.getDensity(i) / 1000.0 - 1.0 for i in range(args.particles)], 0.0)
    more["own_density_error_mean"], more["own_density_error_p99"] = float(own.mean()), peer.rank(own.tolist(), 0.99)
    ratios = peer.densities(found, size, args.spacing)
    version = importlib.metadata.version("pysplishsplash")
    peer.report(args, "SPlisHSPlasH PBF", version, peer.processor(), times, ratios, **more)


if __name__ == "__main__":
    main()
