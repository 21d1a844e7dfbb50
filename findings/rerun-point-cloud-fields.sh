#!/bin/sh
# Rerun's import of MCAP keeps a foxglove.PointCloud's positions and colours alone. All other fields are lost without a word.
set -eu
RERUN=${RERUN:-0.41.0}

there=$(mktemp -d)
trap 'rm -rf "$there"' EXIT
trap 'exit 2' INT TERM
python3 -m venv "$there/venv" || exit 2
"$there/venv/bin/pip" install -q --disable-pip-version-check "rerun-sdk==$RERUN" \
    mcap-protobuf-support==0.6.0 foxglove-schemas-protobuf==0.4.0 protobuf==7.36.2 || exit 2

cd "$there"
# Rerun writes its settings there.
export HOME="$there" RERUN_ANALYTICS=off
"$there/venv/bin/python" - <<'END_OF_PYTHON'
import os
import struct
import subprocess
import sys
from importlib.metadata import version

from foxglove_schemas_protobuf.PackedElementField_pb2 import PackedElementField as Field
from foxglove_schemas_protobuf.PointCloud_pb2 import PointCloud
from mcap_protobuf.writer import Writer
from rerun.chunk import RrdReader

RERUN = os.path.join(os.path.dirname(sys.executable), "rerun")
# Numbers that f32 has exactly and that are nowhere else in the file.
TEMPERATURE, ACID = 301.5, 0.625
FIELDS = [(name, Field.FLOAT32, 4) for name in ("x", "y", "z")]
FIELDS += [(name, Field.UINT8, 1) for name in ("red", "green", "blue", "alpha")]
FIELDS += [("temperature", Field.FLOAT32, 4), ("acid", Field.FLOAT32, 4)]

cloud = PointCloud(frame_id="world", point_stride=24)
cloud.timestamp.FromSeconds(1)
cloud.pose.orientation.w = 1
offset = 0
for name, kind, size in FIELDS:
    cloud.fields.add(name=name, offset=offset, type=kind)
    offset += size
points = [(x, 0, 0, 255, 128, 0, 255, TEMPERATURE, ACID) for x in range(3)]
cloud.data = b"".join(struct.pack("<3f4B2f", *point) for point in points)
with open("cloud.mcap", "wb") as file, Writer(file) as writer:
    writer.write_message("/cloud", cloud, log_time=10**9, publish_time=10**9)


def imported(*decoder):
    """Columns of /cloud that are data, their values as text, and the log."""
    done = subprocess.run(
        [RERUN, "mcap", "convert", "cloud.mcap", "-o", "cloud.rrd", *decoder],
        capture_output=True, text=True, check=True, env={**os.environ, "RUST_LOG": "debug"},
    )
    columns = {}
    for chunk in RrdReader("cloud.rrd").stream():
        if chunk.entity_path == "/cloud":
            columns.update(chunk.to_record_batch().to_pydict())
    described = ("rerun.controls.", "Mcap", "message_", "timestamp")
    columns = {name: str(value) for name, value in columns.items() if not name.startswith(described)}
    return sorted(columns), " ".join(columns.values()), done.stdout + done.stderr


check = subprocess.run([RERUN, "mcap", "check", "cloud.mcap", "--full"], capture_output=True)
names, values, log = imported()
raw_names, raw_values, _ = imported("--decoder", "protobuf")
logged = any(word in log for word in ("temperature", "acid", "field"))

print(f"rerun-sdk {version('rerun-sdk')}, foxglove-schemas-protobuf {version('foxglove-schemas-protobuf')}")
print(f"A cloud of three points has the fields {', '.join(name for name, _, _ in FIELDS)}.")
print("Expected: each field can be read after the import, or the log names those that were left out.")
print(f"Seen: `rerun mcap check` accepts the file ({check.returncode}). The import has {', '.join(names)}.")
print(f"Temperature {TEMPERATURE} is in it: {str(TEMPERATURE) in values}. Acid {ACID} is in it: {str(ACID) in values}.")
print(f"The log, which includes debug lines, names a field: {logged}.")
print(f"A way round: `--decoder protobuf` has {', '.join(raw_names)}, still packed: {'temperature' in raw_values}.")

same = names == ["CoordinateFrame:frame", "InstancePoses3D:quaternions", "InstancePoses3D:translations",
                 "Points3D:colors", "Points3D:positions"]
lost = str(TEMPERATURE) not in values and str(ACID) not in values
if not (same and lost and not logged and check.returncode == 0 and "temperature" in raw_values):
    sys.exit("CHANGED: this is no longer what the first lines of this script describe.")
END_OF_PYTHON
