#!/bin/sh
# Rerun's import of MCAP drops all transforms of a topic's chunk if one message of it has an empty list of transforms.
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
import subprocess
import sys
from importlib.metadata import version

from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms
from mcap_protobuf.writer import Writer
from rerun.chunk import RrdReader

RERUN = os.path.join(os.path.dirname(sys.executable), "rerun")
SECOND = 10**9


def write(empty, chunk_size):
    """Five seconds of two topics. At the seconds `empty`, /flasks has a message without transforms."""
    with open("tf.mcap", "wb") as file, Writer(file, chunk_size=chunk_size) as writer:
        for second in range(1, 6):
            for topic in ("/flasks", "/hands"):
                message = FrameTransforms()
                if topic == "/hands" or second not in empty:
                    pose = message.transforms.add(parent_frame_id="world", child_frame_id=topic[1:])
                    pose.timestamp.FromSeconds(second)
                    pose.rotation.w = 1
                writer.write_message(topic, message, log_time=second * SECOND, publish_time=second * SECOND)


def imported(empty, chunk_size=2**20):
    """Rows with transforms of /flasks and /hands, what the exit statuses of check and import were, lines of errors."""
    write(empty, chunk_size)
    check = subprocess.run([RERUN, "mcap", "check", "tf.mcap", "--full"], capture_output=True)
    done = subprocess.run([RERUN, "mcap", "convert", "tf.mcap", "-o", "tf.rrd"], capture_output=True, text=True)
    rows = {"/flasks": 0, "/hands": 0}
    for chunk in RrdReader("tf.rrd").stream():
        if any(name.startswith("Transform3D:") for name in chunk.to_record_batch().schema.names):
            rows[chunk.entity_path] += chunk.num_rows
    errors = [line.split("importer")[-1] for line in done.stderr.splitlines() if "ERROR" in line]
    return (*rows.values(), check.returncode, done.returncode), errors


full, _ = imported(empty=[])
hole, errors = imported(empty=[3])
small, _ = imported(empty=[3], chunk_size=1)

print(f"rerun-sdk {version('rerun-sdk')}, foxglove-schemas-protobuf {version('foxglove-schemas-protobuf')}")
print("A recording has five messages in /flasks and five in /hands, each with one transform.")
print(f"Seen: {full[0]} rows of /flasks and {full[1]} of /hands are imported.")
print("In a second recording the third message of /flasks has an empty list, which the schema permits.")
print("Expected: the 4 other rows of /flasks are imported, or the command fails.")
print(f"Seen: {hole[0]} rows of /flasks and {hole[1]} of /hands are imported.")
print(f"`rerun mcap check` ends with {hole[2]} and `rerun mcap convert` with {hole[3]}. The log has {len(errors)} error:")
for error in errors:
    print("   ", error.lstrip("\x1b[0m2:").strip())
print(f"With one message in each of the file's chunks, {small[0]} rows of /flasks are imported: only that chunk is lost.")

if (full, hole, small, len(errors)) != ((5, 5, 0, 0), (0, 5, 0, 0), (4, 5, 0, 0), 1):
    sys.exit("CHANGED: this is no longer what the first lines of this script describe.")
END_OF_PYTHON
