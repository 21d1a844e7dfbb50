#!/bin/sh
# meshio reads a scalar of a .vtu file as a column if the file spells out its one component, and then leaves it out of PLY.
# Names with spaces, which .vtu permits, are refused in legacy VTK and make PLY headers that meshio itself cannot read.
set -eu
MESHIO=${MESHIO:-5.3.5}

there=$(mktemp -d)
trap 'rm -rf "$there"' EXIT
trap 'exit 2' INT TERM
python3 -m venv "$there/venv" || exit 2
"$there/venv/bin/pip" install -q --disable-pip-version-check "meshio==$MESHIO" numpy==2.4.6 || exit 2

cd "$there"
"$there/venv/bin/python" - <<'END_OF_PYTHON'
import contextlib
import io
import sys
from importlib.metadata import version

import meshio

MESH = """<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="3" NumberOfCells="1">
<PointData><DataArray type="Float32" Name="{name}" {components} format="ascii">1 2 3</DataArray></PointData>
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points>
<Cells>
<DataArray type="Int32" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray>
</Cells></Piece></UnstructuredGrid></VTKFile>
"""


def read(name, components):
    with open("mesh.vtu", "w") as file:
        file.write(MESH.format(name=name, components=components))
    return meshio.read("mesh.vtu")


def ply(mesh):
    """Properties in the header of the mesh as PLY, other than coordinates and corners, and what meshio prints meanwhile."""
    with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()) as err:
        mesh.write("mesh.ply", binary=False)
    with open("mesh.ply") as file:
        lines = [line.strip() for line in file]
    properties = [line for line in lines if line.startswith("property ") and "list" not in line]
    return [it for it in properties if it.split()[2] not in "xyz"], " ".join((out.getvalue() + err.getvalue()).split())


def legacy(mesh):
    try:
        mesh.write("mesh.vtk")
    except meshio.WriteError as error:
        return str(error)
    return "written"


silent, spelt = read("heat", ""), read("heat", 'NumberOfComponents="1"')
shapes = silent.point_data["heat"].shape, spelt.point_data["heat"].shape
kept, (lost, warning) = ply(silent)[0], ply(spelt)
spaced = read("heat of mixing", "")
header, refused = ply(spaced)[0], legacy(spaced)

print(f"meshio {version('meshio')}, numpy {version('numpy')}")
print("Two .vtu files have a scalar `heat` at three points; one spells out NumberOfComponents=1, which is also the default.")
print("Expected: both give an array of the same shape, and both scalars are in a PLY file made of them.")
print(f"Seen: the shapes are {shapes[0]} and {shapes[1]}. The PLY files have {kept} and {lost}.")
print(f"The second time meshio prints: {warning}")
print("A third file names its scalar `heat of mixing`.")
print("Expected: in PLY and legacy VTK, whose names are words, the spaces are replaced or escaped, or both are refused.")
print(f"Seen: legacy VTK: {refused} PLY is written, and its header has {header}, which is no name and type of a property.")

expected = ((3,), (3, 1)), ["property float heat"], [], ["property float heat of mixing"]
if (shapes, kept, lost, header) != expected or "multidimensional" not in warning or "spaces" not in refused:
    sys.exit("CHANGED: this is no longer what the first lines of this script describe.")
END_OF_PYTHON
