#!/bin/sh
# meshio reads the field data of a .vtu file, such as the time of its state, but loses it when it writes the mesh as .vtu again.
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
<FieldData><DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">4.5</DataArray></FieldData>
<Piece NumberOfPoints="3" NumberOfCells="1">
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points>
<Cells>
<DataArray type="Int32" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray>
</Cells></Piece></UnstructuredGrid></VTKFile>
"""
with open("first.vtu", "w") as file:
    file.write(MESH)

first = meshio.read("first.vtu").field_data
after, printed = {}, ""
for ending in ("vtu", "vtk"):
    with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()) as err:
        meshio.read("first.vtu").write(f"second.{ending}")
    printed += out.getvalue() + err.getvalue()
    with open(f"second.{ending}", "rb") as file:
        in_file = b"TimeValue" in file.read()
    after[ending] = in_file, "TimeValue" in meshio.read(f"second.{ending}").field_data

print(f"meshio {version('meshio')}")
print("A .vtu file has the time 4.5 s in its field data, by the name that ParaView reads.")
print(f"meshio reads it: {({name: value.tolist() for name, value in first.items()})}.")
print("Expected: it is in the file that meshio writes of the mesh, or a warning says that it is left out.")
for ending, (in_file, read) in after.items():
    print(f"Seen: it is in the new .{ending} file: {in_file}; meshio reads it there: {read}.")
print(f"meshio prints {printed.strip() or 'nothing'!r}.")

if first["TimeValue"].tolist() != [4.5] or after != {"vtu": (False, False), "vtk": (False, False)} or printed.strip():
    sys.exit("CHANGED: this is no longer what the first lines of this script describe.")
END_OF_PYTHON
