"""What Ralph and Python read of statements and of a class's file.

Ralph's command `validate` knows the statements of some profiles alone (video, learning management systems and such), and passes
over all others as unknown. So each is held against the model that those are all made from: it has the rules of xAPI 1.0.3 for
a statement (names of properties, identifiers as RFC 3987 and 4122 have them, languages, nothing empty). Numbers as text and durations
as numbers it takes too (findings/ralph-validated-statements.sh), so their types are looked at here.
"""

import datetime
import json
import sqlite3
import sys
import uuid

from ralph.models.xapi.base.statements import BaseXapiStatement

lines, class_file, attempt = sys.argv[1:]

found = []
with open(lines, encoding="utf-8") as file:
    for position, line in enumerate(file):
        given = json.loads(line)
        result_given = given.get("result", {})
        assert all(type(it) in (int, float) for it in result_given.get("score", {}).values()), line
        assert type(result_given.get("duration", "")) is str, line
        statement = BaseXapiStatement(**given)
        expected = uuid.uuid5(uuid.UUID(attempt), f"statement/{position}")
        assert statement.id == expected, (statement.id, expected)
        assert statement.timestamp.utcoffset() == datetime.timedelta(0)
        result = statement.result
        score = result and result.score
        found.append(
            {
                "verb": str(statement.verb.id).rsplit("/", 1)[1],
                "object": str(statement.object.id).split("#")[1],
                "time": statement.timestamp.replace(tzinfo=None).isoformat(timespec="milliseconds"),
                "duration_s": result and result.duration.total_seconds(),
                "score": score and [float(it) for it in (score.scaled, score.raw, score.min, score.max)],
                "success": result and result.success,
                "completion": result and result.completion,
                "name": statement.actor.account.name,
            }
        )

with sqlite3.connect(class_file) as tables:
    students = tables.execute("SELECT pseudonym, attempts, incidents, best_score FROM students").fetchall()
    spilt = tables.execute("SELECT surface, volume_m3 FROM incidents WHERE kind = 'spilt'").fetchall()

print(json.dumps({"statements": found, "students": students, "spilt": spilt}))
