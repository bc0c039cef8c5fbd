// SPDX-License-Identifier: MIT
// Reports as a user makes them, of recordings whose truth is known: four of diagnoses, and the pages of other commands.
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
  { name: "unknown", joints: 3, rows: "effect oddity joint=3 a=1.5 v=1\n", verdict: "unexplained_structure",
    findings: 1, uncertain: 1 },
];
/** Of a recording: what must stay text. */
export const kEvil = "<img src=x onerror=alert(1)>&amp;.csv";


const kFindings = {
  schema: "dynid.diagnosis/1", robot: "arm", joints: 3, verdict: "explained",
  findings: [{ family: "load_friction", joint: 2, other_joint: null, aliases: ["load_friction", "torque_saturation"],
    probability: 0.6, formula: "", parameters: { mu: { value: 0.08, std: null, unit: "1" } } }],
  base_parameters: [], heldout: { noise_floor: [0.3, 0.3, 0.3] },
};
const kLimits = `
qmin       -2.8  -2.0  -2.6  # [rad]
qmax        2.8   2.0   2.6  # [rad]
vmax        2.5   2.5   3    # [rad/s]
amax       12    12    15    # [rad/s^2]
`;

/** What other commands write; `words` follow the robot. */
export const kPages = [
  { name: "fit", command: "fit", joints: 3, charts: 4, matrix: false, result: /base parameters fitted by wls/,
    rows: "effect load_friction joint=3 mu=0.12\n",
    words: ["run1.csv", "--holdout", "run2.csv", "--method", "all"],
    sections: ["verdict", "parameters", "torque", "ripple", "methods", "conditioning", "condition", "origin"],
    figures: ["rms", "torque-joint-1", "torque-joint-3"] },
  { name: "fit-effects", command: "fit", joints: 3, charts: 4, matrix: false, result: /base parameters fitted by wls/,
    rows: "effect load_friction joint=3 mu=0.12\n", told: "effect load_friction joint=3 mu=*\n",
    words: ["run1.csv", "--holdout", "run2.csv"],
    sections: ["verdict", "parameters", "effects", "torque", "ripple", "conditioning", "condition", "origin"],
    figures: ["rms", "torque-joint-2"] },
  { name: "atlas", command: "atlas", joints: 3, charts: 0, matrix: true, result: /this motion can show/, rows: "",
    words: ["run1.csv"], sections: ["verdict", "absorbed", "alike", "noise", "origin"], figures: ["seen", "likeness"] },
  { name: "excite", command: "excite", joints: 3, charts: 1, matrix: false, result: /condition number/, rows: "",
    told: kLimits, words: ["--evaluations", "300", "-o", "motion.csv"],
    sections: ["verdict", "trajectory", "parameters", "search", "origin"], figures: ["limits", "motion"] },
  { name: "experiment", command: "excite", joints: 3, charts: 1, matrix: false, result: /load_friction from torque_saturation/,
    rows: "", told: kLimits, words: ["--for", "findings.json", "--evaluations", "60", "-o", "motion.csv"],
    sections: ["verdict", "trajectory", "search", "origin"], figures: ["separation", "limits", "motion"] },
];

/** @returns the path of a page, of a recording of the plant where the command reads one */
export function makePage({ name, command, rows, told = "", words }, { dynid, record }, folder) {
  const own = join(folder, name);
  mkdirSync(own, { recursive: true });
  const text = readFileSync(join(root, "tests/studies/robots/puma3.robot"), "utf8");
  writeFileSync(join(own, "plant.robot"), text.replace(/\nstop/, `\n${rows}stop`));
  writeFileSync(join(own, "arm.robot"), text.replace(/\nstop/, `\n${told}stop`));
  writeFileSync(join(own, "findings.json"), JSON.stringify(kFindings));
  const run = (program, ...all) => execFileSync(program, all, { cwd: own, stdio: ["ignore", "pipe", "inherit"], encoding: "utf8" });
  if (words[0].endsWith(".csv")) {
    run(record, "plant.robot", here, "3", "20", "run1.csv");
    run(record, "plant.robot", here, "4", "20", "run2.csv");
  }
  writeFileSync(join(own, "terminal.txt"), run(dynid, command, "arm.robot", ...words, "--report", "report.html", "--figures", "figures"));
  return join(own, "report.html");
}

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
