// SPDX-License-Identifier: MIT
// Four reports as a user makes them, of recordings whose truth is known.
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const root = process.env.DYNGEN_SOURCES;
const here = join(root, "tests/report");

export const kCases = [
  { name: "clean", joints: 3, rows: "", verdict: "clean", findings: 0 },
  { name: "one", joints: 3, rows: "effect load_friction joint=3 mu=0.12\n", verdict: "explained", findings: 1 },
  { name: "two", joints: 3, rows: "effect load_friction joint=3 mu=0.12\neffect cogging joint=2 a=1.5 b=0.6 n=24\n",
    verdict: "explained", findings: 2 },
  { name: "unknown", joints: 3, rows: "effect oddity joint=3 a=1.5 v=1\n", verdict: "unexplained_structure", findings: 0 },
];
/** Of a recording: what must stay text. */
export const kEvil = "<img src=x onerror=alert(1)>&amp;.csv";

/** @returns the path of the report of a case */
export function makeReport({ name, rows }, { dynid, record }, folder) {
  const own = join(folder, name);
  mkdirSync(own, { recursive: true });
  const robot = join(root, "tests/studies/robots/puma3.robot");
  writeFileSync(join(own, "plant.robot"), readFileSync(robot, "utf8").replace(/\nstop/, `\n${rows}stop`));
  const run = (program, ...words) =>
    execFileSync(program, words, { cwd: own, stdio: ["ignore", "pipe", "inherit"], encoding: "utf8" });
  const train = name === "one" ? kEvil : "run1.csv", heldout = "run2.csv";
  run(record, "plant.robot", here, "3", "20", train);
  run(record, "plant.robot", here, "4", "20", heldout);
  const text = run(dynid, "diagnose", robot, train, "--holdout", heldout, "--json", "findings.json", "--report",
    "report.html", "--figures", "figures", "-o", "improved.robot");
  writeFileSync(join(own, "terminal.txt"), text);
  return join(own, "report.html");
}
