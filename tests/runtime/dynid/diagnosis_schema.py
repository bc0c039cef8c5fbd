#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The JSON of dynid diagnose is what docs/reference/diagnosis.schema.json says, on the recording of examples/urdf_and_bag.

    python3 tests/runtime/dynid/diagnosis_schema.py DYNID PROJECT [FINDINGS.json ...]

Further files are validated too. Exit code 77: skipped, since python3-jsonschema or an optional part of dynid is absent.
"""

import copy
import json
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
try:
    from jsonschema import Draft202012Validator
except ImportError:
    print("skipped: python3-jsonschema is not installed")
    sys.exit(SKIPPED)


def faults(validator, answer):
    return ["/" + "/".join(map(str, e.path)) + ": " + e.message[:200] for e in validator.iter_errors(answer)]


def answer_of_example(dynid, project, folder):
    example = project / "examples/urdf_and_bag"
    arm, bag = str(example / "arm.urdf"), str(example / "run.db3")
    for command in (
        ["import", "--guess", bag, "--robot", arm, "-o", "map.yaml"],
        ["diagnose", arm, bag, "--map", "map.yaml", "--json", "findings.json"],
    ):
        done = subprocess.run([dynid] + command, cwd=folder, capture_output=True, text=True)
        if done.returncode == 2:
            print("skipped: " + done.stderr)
            sys.exit(SKIPPED)
        if done.returncode != 0:
            sys.exit(f"dynid {' '.join(command)} ended with {done.returncode}\n{done.stdout}{done.stderr}")
    return json.loads((Path(folder) / "findings.json").read_text(encoding="utf-8"))


def wrong_copies(answer):
    """Answers that the schema must refuse."""
    for key in answer:
        wrong = copy.deepcopy(answer)
        del wrong[key]
        yield f"without {key}", wrong
    for name, change in (
        ("unknown verdict", {"verdict": "fine"}),
        ("unknown key", {"remark": ""}),
        ("another schema", {"schema": "dynid.diagnosis/2"}),
        ("text as number", {"joints": "two"}),
    ):
        yield name, {**copy.deepcopy(answer), **change}
    for name, change in (
        ("family unknown", {"family": "unknown"}),
        ("probability of 2", {"probability": 2}),
        ("no alias", {"aliases": []}),
        ("variable without a joint", {"where": {**answer["findings"][0]["where"], "variable": "q"}}),
    ):
        wrong = copy.deepcopy(answer)
        wrong["findings"][0].update(change)
        yield name, wrong


def main():
    dynid, project = sys.argv[1], Path(sys.argv[2]).resolve()
    schema = json.loads((project / "docs/reference/diagnosis.schema.json").read_text(encoding="utf-8"))
    Draft202012Validator.check_schema(schema)
    validator = Draft202012Validator(schema)
    with tempfile.TemporaryDirectory() as folder:
        answer = answer_of_example(dynid, project, folder)
    found = faults(validator, answer)
    if not answer["findings"]:
        found.append("the example has no finding: nothing of findings was validated")
    else:
        found += [f"accepted: {name}" for name, wrong in wrong_copies(answer) if not faults(validator, wrong)]
    for name in sys.argv[3:]:
        found += [f"{name}{fault}" for fault in faults(validator, json.loads(Path(name).read_text(encoding="utf-8")))]
    if found:
        sys.exit("\n".join(found))
    print("the answer fits the schema; wrong answers do not")


main()
