// SPDX-License-Identifier: MIT
// A page in headless Chromium as a reader uses it, and what is asked of every page.
//   CHROMIUM        the browser
//   SCREENSHOTS     folder for pictures; none: no pictures
import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { after, before } from "node:test";
import { pathToFileURL } from "node:url";
import { HtmlValidate } from "html-validate";
import { chromium } from "playwright-core";

const { SCREENSHOTS, CHROMIUM = "/usr/bin/chromium" } = process.env;
export const kMostBytes = 5e6, kMostSeconds = 2;
const validator = new HtmlValidate({
  extends: ["html-validate:recommended"],
  rules: {
    "long-title": "off",
    "no-raw-characters": "off",
    // of what scripts make: charts and bars have sizes of their own
    "no-inline-style": "off",
    "attribute-boolean-style": "off",
    "void-style": "off",
  },
});
let browser;

before(async () => {
  browser = await chromium.launch({ executablePath: CHROMIUM, args: ["--no-sandbox", "--disable-gpu"] });
});
after(() => browser?.close());

/** Opens a report and notes whatever it should not do. */
export async function open(path, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 }, ...options });
  const faults = [], requests = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) faults.push(message.text());
  });
  page.on("pageerror", (error) => faults.push(error.message));
  page.on("dialog", (dialog) => {
    faults.push(`dialog ${dialog.message()}`);
    dialog.dismiss();
  });
  page.on("request", (request) => requests.push(request.url()));
  await page.goto(pathToFileURL(path).href);
  await page.waitForFunction(() => document.documentElement.dataset.drawn === "all" && document.documentElement.dataset.seconds);
  return { page, faults, requests };
}

/** From the call to the first screen and a half painted: the best of three, since a machine does other things too. */
export async function secondsToDrawn(path) {
  let best = Infinity;
  for (let i = 0; i < 3; ++i) {
    const { page } = await open(path);
    best = Math.min(best, await page.evaluate(() => Number(document.documentElement.dataset.seconds)));
    await page.close();
  }
  return best;
}

/** Of every canvas: its painted pixels and how many colours they have. */
export const painted = (page) => page.evaluate(() => [...document.querySelectorAll("figure.chart canvas")].map((canvas) => {
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const colours = new Set();
  let pixels = 0;
  for (let i = 0; i < data.length; i += 4) {
    if (data[i + 3] < 40) continue;
    ++pixels;
    colours.add((data[i] >> 4) * 256 + (data[i + 1] >> 4) * 16 + (data[i + 2] >> 4));
  }
  return { id: canvas.closest("figure").id, pixels, colours: colours.size };
}));

export const picture = (figure) => figure.locator("canvas").first().evaluate((canvas) => canvas.toDataURL());

export async function screenshot(page, name) {
  if (!SCREENSHOTS) return;
  mkdirSync(SCREENSHOTS, { recursive: true });
  await page.screenshot({ path: join(SCREENSHOTS, `${name}.png`) });
}

function messages(report) {
  return report.results.flatMap((result) => result.messages.map((own) => `${own.ruleId}: ${own.message} at ${own.line}`));
}

/** What is wrong with a page as HTML: as it is written, and as it is shown. */
export async function htmlFaults(...texts) {
  const reports = await Promise.all(texts.map((text) => validator.validateString(text)));
  return reports.flatMap(messages);
}

/** Pixels that a page is wide on a phone; keeps a picture of it. */
export async function widthOnPhone(page, name) {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.evaluate(() => scrollTo(0, 0));
  await page.waitForTimeout(200);
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  await screenshot(page, `${name}-phone`);
  await page.setViewportSize({ width: 1280, height: 720 });
  return width;
}

export async function assertSoon(condition, words) {
  for (let i = 0; i < 60; ++i) {
    if (await condition()) return;
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  assert.fail(words);
}
