#!/bin/sh
# FLIP takes arrays with four channels for pictures with three. So it compares the first three quarters of their rows alone, and
# those as other colours, and gives no error. Of files with four channels it reads three.
set -eu
FLIP=${FLIP:-1.7}

there=$(mktemp -d)
trap 'rm -rf "$there"' EXIT
trap 'exit 2' INT TERM
python3 -m venv "$there/venv" || exit 2
"$there/venv/bin/pip" install -q --disable-pip-version-check "flip-evaluator==$FLIP" numpy==2.4.6 pillow==13.0.0 || exit 2

cd "$there"
"$there/venv/bin/python" - <<'END_OF_PYTHON'
import sys
from importlib.metadata import version

import flip_evaluator
import numpy
from PIL import Image

SIDE = 64
QUARTERS = "first", "second", "third", "last"


def saved(name, white=slice(0)):
    """An opaque grey picture with white rows, as a PNG file; the array that Pillow reads of it, 0 to 1."""
    picture = numpy.full((SIDE, SIDE, 4), 128, "u1")
    picture[white, :, :3] = 255
    picture[..., 3] = 255
    Image.fromarray(picture).save(name)
    return numpy.asarray(Image.open(name), "f4") / 255


def compared(reference, test, kind="LDR"):
    """Mean error, and how many of the map's rows have an error over 0.05 in each quarter."""
    errors, mean, _ = flip_evaluator.evaluate(reference, test, kind, applyMagma=False)
    rows = (numpy.asarray(errors)[..., 0] > 0.05).any(axis=1)
    return mean, rows.reshape(4, -1).sum(axis=1).tolist()


grey = saved("grey.png")
found = {}
for number, name in enumerate(QUARTERS):
    white = saved("white.png", slice(number * SIDE // 4, (number + 1) * SIDE // 4))
    found[name] = {
        "files": compared("grey.png", "white.png"),
        "arrays of three": compared(grey[..., :3], white[..., :3]),
        "arrays of four": compared(grey, white),
        "arrays of four, HDR": compared(grey, white, "HDR"),
    }

print(f"flip-evaluator {version('flip-evaluator')}, numpy {version('numpy')}, Pillow {version('pillow')}")
print(f"Two opaque RGBA pictures of {SIDE} rows are grey, and a quarter of the rows of one is white.")
print("The documentation of evaluate() asks for arrays of height x width x channels, and names no number of channels.")
print("Expected: files and arrays give the same error, or arrays with a fourth channel are refused.")
for name, ways in found.items():
    print(f"Seen where the {name} quarter is white (mean error; rows with errors in each quarter):")
    for way, (mean, rows) in ways.items():
        print(f"    {way:20} {mean:.3f}  {rows}")

three = all(abs(ways["files"][0] - ways["arrays of three"][0]) < 0.01 and ways["files"][0] > 0.2 for ways in found.values())
blind = all(found["last"][way] == (0.0, [0, 0, 0, 0]) for way in ("arrays of four", "arrays of four, HDR"))
# The third quarter of an array with four channels stands where that of one with three channels has its last.
moved = found["third"]["arrays of four"][1][3] == SIDE // 4 and found["third"]["files"][1][3] < SIDE // 8
if not (three and blind and moved):
    sys.exit("CHANGED: this is no longer what the first lines of this script describe.")
END_OF_PYTHON
