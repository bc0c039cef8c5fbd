#!/usr/bin/env python3
"""coverage.py BUILD: lines of gen/ and runtime/ that ran, of gcov's counts below a build folder, by folder and in all."""
import collections
import json
import pathlib
import subprocess
import sys


def counts_of(build, root):
    """path -> line -> how often it ran; a line of a header is in many programs."""
    lines = collections.defaultdict(lambda: collections.defaultdict(int))
    notes = sorted(build.rglob("*.gcno"))
    for begin in range(0, len(notes), 50):
        files = [str(note) for note in notes[begin:begin + 50]]
        text = subprocess.run(["gcov", "--json-format", "--stdout", *files], capture_output=True, text=True,
                              check=True, cwd=build).stdout
        for document in filter(None, text.split("\n")):
            report = json.loads(document)
            for file in report["files"]:
                path = pathlib.Path(report["current_working_directory"], file["file"]).resolve()
                if not path.is_relative_to(root):
                    continue
                own = lines[str(path.relative_to(root))]
                for line in file["lines"]:
                    own[line["line_number"]] += line["count"]
    return lines


def main():
    root = pathlib.Path.cwd().resolve()
    lines = counts_of(pathlib.Path(sys.argv[1]).resolve(), root)
    ran, there = collections.Counter(), collections.Counter()
    for path, own in lines.items():
        parts = pathlib.PurePath(path).parts
        if parts[0] not in ("gen", "runtime") or len(parts) < 3:
            continue
        for folder in ("/".join(parts[:2]), parts[0], "all"):
            there[folder] += len(own)
            ran[folder] += sum(count > 0 for count in own.values())
    print(f"{'folder':<28}{'lines':>8}{'ran':>8}{'share':>9}")
    for folder in sorted(there, key=lambda name: (name == "all", name)):
        print(f"{folder:<28}{there[folder]:>8}{ran[folder]:>8}{100 * ran[folder] / there[folder]:>7.1f} %")


if __name__ == "__main__":
    main()
