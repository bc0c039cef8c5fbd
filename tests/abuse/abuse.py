#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Damaged recordings into dynid fit: each is fitted rightly, refused, or warned of.

    abuse.py --dynid PATH --dyngen PATH [--count N] [--seed S] [--kinds A,B] [--keep FOLDER]

Every kind of damage of damage/ is done at random strength to recordings of three arms. An outcome is
  right    every base parameter that the fit calls seen is within 5 deviations or 5 % of the truth
  refused  the exit code is not 0 and no parameter that is called seen is wrong
  warned   what was said names the kind of damage
  wrong    none of these: a wrong number without a word
  crash    a signal, an internal error, or a sanitizer's report
Ends with 1 if one is wrong or crashed.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import arms
import damage

OUTCOMES = ("right", "refused", "warned", "wrong", "crash")
CRASH = re.compile(r"internal error|Sanitizer|runtime error:|terminate called")


def run(dynid, arguments):
    done = subprocess.run([dynid, *map(str, arguments)], capture_output=True, text=True,
                          errors="replace", timeout=600, check=False)
    return done.returncode, done.stdout + done.stderr, done.stderr


def truth_of(arm, dynid, folder):
    """Base parameters: their names, and the values that the numbers of the file have."""
    path, answer = folder / f"{arm.name}_clean.csv", folder / f"{arm.name}_clean.json"
    path.write_text(damage.text_of(damage.plain(arm.recording(np.random.default_rng(1)))))
    run(dynid, ["fit", arm.true_file, path, "--json", answer])
    return {p["name"]: p["before"] for p in json.loads(answer.read_text())["parameters"]}


def mistakes(answer, truth):
    """Seen parameters that are off by more than 5 deviations and by more than 5 %."""
    found = []
    for p in json.loads(answer.read_text())["parameters"]:
        if p["seen"] == "no" or p["value"] is None or p["name"] not in truth:
            continue
        off = abs(p["value"] - truth[p["name"]])
        if off > 5 * (p["std"] or 0) and off > 0.05 * abs(truth[p["name"]]):
            found.append(f"{p['name']} {p['value']:.4g} +- {p['std'] or 0:.2g}, true {truth[p['name']]:.4g}")
    return found


def judged(arm, kind, seed, dynid, folder, truth):
    random = np.random.default_rng(seed)
    file = kind.make(arm.recording(random), random, arm)
    name = f"{arm.name}_{kind.name}_{seed}"
    path, answer, robot = folder / f"{name}.csv", folder / f"{name}.json", arm.open_file
    path.write_text(damage.text_of(file), encoding="utf-8", newline="")
    if file.robot:
        robot = folder / f"{name}.robot"
        robot.write_text(file.robot(arm))
    try:
        code, words, errors = run(dynid, ["fit", robot, path, "--json", answer, *file.options])
    except subprocess.TimeoutExpired:
        return "crash", name, "no answer after 600 s"
    if code < 0 or code >= 64 or CRASH.search(words):
        return "crash", name, words[-500:]
    off = mistakes(answer, truth) if answer.exists() else []
    said = bool(kind.words) and re.search(kind.words, errors) is not None
    outcome = ("refused" if code != 0 and not off else "right" if not off
               else "warned" if said else "wrong")
    if outcome != "wrong":
        path.unlink()
    return outcome, name, "; ".join(off[:4])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--dynid", required=True)
    parser.add_argument("--dyngen", required=True)
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kinds", default="")
    parser.add_argument("--keep", default="")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    wanted = [damage.KINDS[name] for name in options.kinds.split(",") if name] or list(damage.KINDS.values())
    with tempfile.TemporaryDirectory() as made:
        folder = pathlib.Path(options.keep or made)
        folder.mkdir(parents=True, exist_ok=True)
        robots = {name: arms.Arm(name, folder, options.dyngen) for name in arms.GEOMETRY}
        truths = {name: truth_of(arm, options.dynid, folder) for name, arm in robots.items()}
        # all kinds first, then each of them on another arm
        pairs = [(robots[kind.arms[(turn + place) % len(kind.arms)]], kind)
                 for turn in range(len(robots)) for place, kind in enumerate(wanted)]
        tasks = [(*pairs[i % len(pairs)], options.seed * 100003 + i) for i in range(options.count)]
        with ThreadPoolExecutor(options.jobs) as pool:
            results = list(pool.map(
                lambda task: (task[1].name, judged(*task, options.dynid, folder, truths[task[0].name])),
                tasks))
    print(f"{len(tasks)} files, {len(wanted)} kinds, seed {options.seed}")
    print(f"{'kind':<26}" + "".join(f"{outcome:>9}" for outcome in OUTCOMES))
    sums = dict.fromkeys(OUTCOMES, 0)
    for kind in wanted:
        own = [result[0] for name, result in results if name == kind.name]
        for outcome in own:
            sums[outcome] += 1
        print(f"{kind.name:<26}" + "".join(f"{own.count(outcome):>9}" for outcome in OUTCOMES))
    print(f"{'all':<26}" + "".join(f"{sums[outcome]:>9}" for outcome in OUTCOMES))
    for name, (outcome, file, words) in results:
        if outcome in ("wrong", "crash"):
            print(f"{outcome}: {file}: {words}")
    return 1 if sums["wrong"] + sums["crash"] else 0


if __name__ == "__main__":
    sys.exit(main())
