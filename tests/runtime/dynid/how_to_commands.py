#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The commands of docs/howto/first_diagnosis.md run, in their order, in a copy of the example's files.

    python3 tests/runtime/dynid/how_to_commands.py DYNID DYNGEN PROJECT

Exit code 77: skipped, since an optional part of dynid or dyngen is absent.
"""

import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

EXPECTED = {"excite": 3}  # no motion separates the two names; the page says so


def main():
    tools = {"dynid": sys.argv[1], "dyngen": sys.argv[2]}
    project = Path(sys.argv[3]).resolve()
    page = (project / "docs/howto/first_diagnosis.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```sh\n(.*?)^```$", page, flags=re.S | re.M)
    commands = [line for block in blocks for line in block.splitlines() if line.split()[0] in tools]
    if len(commands) < 5:
        sys.exit(f"found {len(commands)} commands, expected 5 or more")
    with tempfile.TemporaryDirectory() as top:
        folder = Path(top) / "first"
        shutil.copytree(project / "examples/urdf_and_bag", folder)
        for command in commands:
            words = shlex.split(command)
            done = subprocess.run([tools[words[0]]] + words[1:], cwd=folder, capture_output=True, text=True)
            if done.returncode == 2:
                print("skipped: " + done.stderr)
                sys.exit(77)
            expected = EXPECTED.get(words[1], 0)
            if done.returncode != expected:
                sys.exit(f"{command}\nended with {done.returncode}, expected {expected}\n{done.stdout}{done.stderr}")
        findings = (folder / "findings.json").read_text(encoding="utf-8")
        identified = (folder / "identified.robot").read_text(encoding="utf-8")
        if '"gravity_spring"' not in findings or "effect linear_spring joint=2" not in identified:
            sys.exit("the spring of the page was not found")
    print(f"{len(commands)} commands")


main()
