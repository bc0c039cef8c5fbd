// SPDX-License-Identifier: MIT
// Bundles the page: node build.mjs OUTPUT. The same sources give the same bytes.
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const output = process.argv[2];
if (!output) {
  console.error("usage: node build.mjs OUTPUT");
  process.exit(2);
}

async function bundled(entry) {
  const result = await build({
    entryPoints: [join(here, "src", entry)],
    absWorkingDir: here,
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    target: ["chrome109", "firefox115", "safari16.4"],
    charset: "ascii",
    legalComments: "inline",
  });
  return result.outputFiles[0].text.trim();
}

const hash = (text) => `'sha256-${createHash("sha256").update(text, "utf8").digest("base64")}'`;

const script = await bundled("main.js");
const style = await bundled("style.css");
if (script.includes("</script")) throw new Error("the script holds the end of its element");
const licence = readFileSync(join(here, "node_modules/uplot/LICENSE"), "utf8").trim();
const policy = [
  "default-src 'none'",
  `script-src ${hash(script)}`,
  `style-src ${hash(style)}`,
  "base-uri 'none'",
  "form-action 'none'",
].join("; ");

let page = readFileSync(join(here, "src/page.html"), "utf8");
const put = (mark, text) => {
  if (page.split(mark).length !== 2) throw new Error(`the page has ${mark} not once`);
  page = page.replace(mark, () => text);
};
put("%LICENCE%", `uPlot\n${licence}`);
put("%POLICY%", policy);
put("%STYLE%", style);
put("%SCRIPT%", script);
writeFileSync(output, page);
