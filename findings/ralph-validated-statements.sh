#!/bin/sh
# `ralph validate` writes out the xAPI statements that it accepts. What it writes has nulls, and scores as text, not as numbers.
# A store must reject both by xAPI 1.0.3 (part two, 2.2). Ralph itself refuses the nulls, and accepts the text.
set -eu
RALPH=${RALPH:-5.1.0}

there=$(mktemp -d)
trap 'rm -rf "$there"' EXIT
trap 'exit 2' INT TERM
python3 -m venv "$there/venv" || exit 2
"$there/venv/bin/pip" install -q --disable-pip-version-check "ralph-malph[cli]==$RALPH" pydantic==2.14.4 || exit 2

cd "$there"
# Ralph keeps its settings there.
export HOME="$there"
"$there/venv/bin/python" - <<'END_OF_PYTHON'
import json
import os
import subprocess
import sys
from importlib.metadata import version

from pydantic import ValidationError
from ralph.models.xapi.base.statements import BaseXapiStatement

RALPH = os.path.join(os.path.dirname(sys.executable), "ralph")
# A page that was left: one of the kinds of statements that the command knows.
STATEMENT = {
    "id": "3f0e4a52-6a3f-4c39-9a55-0d5a3e6f7c11",
    "actor": {"objectType": "Agent", "account": {"homePage": "https://school.example/", "name": "s-17"}},
    "verb": {"id": "http://adlnet.gov/expapi/verbs/terminated"},
    "object": {
        "id": "https://school.example/dilution",
        "definition": {"type": "http://activitystrea.ms/schema/1.0/page"},
    },
    "result": {"score": {"scaled": 0.85, "raw": 17, "min": 0, "max": 20}, "success": True, "duration": "PT62.5S"},
    "timestamp": "2026-11-20T10:00:00.125Z",
}


def validate(line):
    done = subprocess.run([RALPH, "validate", "-f", "xapi"], input=line + "\n", capture_output=True, text=True)
    return done.returncode, done.stdout.strip()


def nulls(value):
    if isinstance(value, dict):
        return sum(map(nulls, value.values()))
    return value is None


def accepted(statement):
    try:
        return BaseXapiStatement(**statement)
    except ValidationError:
        return None


first, written = validate(json.dumps(STATEMENT))
statement = json.loads(written)
second, _ = validate(written)
model = accepted(STATEMENT)
modelled = json.loads(model.model_dump_json(exclude_none=True))["result"]["score"]
text = accepted({**STATEMENT, "result": {"score": modelled}})
seconds = accepted({**STATEMENT, "result": {"duration": 62.5}})
wrong = accepted({**STATEMENT, "result": {"success": "true"}})

print(f"ralph-malph {version('ralph-malph')}, pydantic {version('pydantic')}")
print(f"A valid statement has the score {json.dumps(STATEMENT['result']['score'])} and no nulls.")
print("Expected: `ralph validate` accepts it and writes a statement that is valid too.")
print(f"Seen: it ends with {first} and writes the score {json.dumps(statement['result']['score'])}.")
print(f"There are {nulls(statement)} nulls in what it writes. Of that, `ralph validate` ends with {second}.")
print(f"Without nulls, Ralph's model for all statements writes {json.dumps(modelled)}.")
print("Expected: the model refuses a score that is text, and a duration that is a number, as it refuses `success` as text.")
print(f"Seen: refused are text as a score: {text is None}, a number as a duration: {seconds is None},"
      f" text as success: {wrong is None}.")

scores = {"scaled": "0.85", "raw": "17", "min": "0", "max": "20"}
same = statement["result"]["score"] == modelled == scores
if not (same and nulls(statement) > 9 and first == 0 and second == 1 and text and seconds and wrong is None):
    sys.exit("CHANGED: this is no longer what the first lines of this script describe.")
END_OF_PYTHON
