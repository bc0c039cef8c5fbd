// SPDX-License-Identifier: MIT
// The pages of dynid fit, atlas and excite in headless Chromium.
//   DYNID, RECORD   the programs                   REPORT_FOLDER  where recordings and pages are made
//   DYNGEN_SOURCES  the project                    and what browser.mjs reads
import assert from "node:assert/strict";
import { readFileSync, readdirSync, statSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { pathToFileURL } from "node:url";
import { assertSoon, htmlFaults, kMostBytes, kMostSeconds, open, painted, picture, screenshot, secondsToDrawn, widthOnPhone } from "./browser.mjs";
import { kPages, makePage } from "./reports.mjs";

const { DYNID, RECORD, REPORT_FOLDER } = process.env;

for (const own of kPages) {
  describe(`the page of dynid ${own.command} ("${own.name}")`, () => {
    let path, page, faults, requests;
    before(async () => {
      path = makePage(own, { dynid: DYNID, record: RECORD }, REPORT_FOLDER);
      ({ page, faults, requests } = await open(path));
    });
    after(() => page?.close());

    test("has every section, in order", async () => {
      const sections = await page.locator("main > section").evaluateAll((all) => all.map((section) => section.id));
      assert.deepEqual(sections, own.sections);
      const links = await page.locator("nav a").evaluateAll((all) => all.map((link) => link.getAttribute("href").slice(1)));
      assert.deepEqual(links, sections);
      assert.ok((await page.locator("#origin pre").first().textContent()).startsWith(`dynid ${own.command} `));
    });

    test("shows its result, the arm and bars on the first screen", async () => {
      for (const selector of [".verdict", "svg.arm", ".barfigure .groups"]) {
        const box = await page.locator(selector).first().boundingBox();
        assert.ok(box && box.y >= 0 && box.y + box.height <= 720, `${selector} ends at ${box?.y + box?.height}`);
      }
      assert.match(await page.locator(".verdict").textContent(), own.result);
      assert.equal(await page.locator("svg.arm .joint").count(), own.joints);
      const widths = await page.locator(".fill").evaluateAll((all) => all.map((fill) => fill.getBoundingClientRect().width));
      assert.ok(widths.length >= own.joints && widths.some((width) => width > 20), `${widths}`);
    });

    test("has drawn all its charts", async () => {
      const canvases = await painted(page);
      assert.equal(new Set(canvases.map((canvas) => canvas.id)).size, own.charts);
      for (const { id, pixels, colours } of canvases) {
        assert.ok(pixels > 2000 && colours >= 3, `${id}: ${pixels} pixels of ${colours} colours`);
      }
    });

    test("shows another view of a chart", async () => {
      if (own.charts === 0) return;
      const figure = page.locator("figure.chart").first();
      const first = await picture(figure);
      const select = figure.locator("select");
      assert.ok(await select.locator("option").count() > 1);
      await select.selectOption({ index: 1 });
      await assertSoon(async () => (await picture(figure)) !== first, "another picture");
    });

    test("reads its matrix to those who point and who press keys", async () => {
      const canvas = page.locator("figure.matrix canvas");
      assert.equal(await canvas.count(), own.matrix ? 1 : 0);
      if (!own.matrix) return;
      await canvas.scrollIntoViewIfNeeded();
      const box = await canvas.boundingBox();
      const reading = page.locator("figure.matrix .reading");
      await page.mouse.move(box.x + 0.7 * box.width, box.y + 0.4 * box.height);
      await assertSoon(async () => / and .*: /.test(await reading.textContent()), "a reading");
      const pointed = await reading.textContent();
      await canvas.focus();
      await page.keyboard.press("ArrowLeft");
      await assertSoon(async () => (await reading.textContent()) !== pointed, "arrows walk");
      await page.keyboard.press("Home");
      assert.match(await reading.textContent(), /: 1$/);  // an effect beside itself
      const colours = await canvas.evaluate((node) => {
        const { data } = node.getContext("2d").getImageData(0, 0, node.width, node.height);
        const seen = new Set();
        for (let i = 3; i < data.length; i += 4) seen.add(data[i] >> 4);
        return seen.size;
      });
      assert.ok(colours > 5, `${colours} shades`);
    });

    test("needs no network and says nothing", async () => {
      assert.deepEqual(requests, [pathToFileURL(path).href]);
      assert.deepEqual(faults, []);
    });

    test("is small and quick", async (t) => {
      const bytes = statSync(path).size, seconds = await secondsToDrawn(path);
      t.diagnostic(`${bytes} bytes, drawn after ${seconds.toFixed(2)} s`);
      assert.ok(bytes < kMostBytes);
      assert.ok(seconds < kMostSeconds, `${seconds} s`);
    });

    test("is valid HTML, as it is written and as it is shown", async () => {
      assert.deepEqual(await htmlFaults(readFileSync(path, "utf8"), await page.content()), []);
    });

    test("fits a phone", async () => {
      const width = await widthOnPhone(page, own.name);
      assert.ok(width <= 390, `${width} pixels wide`);
    });

    test("has its figures as files", () => {
      const files = readdirSync(join(REPORT_FOLDER, own.name, "figures"));
      for (const name of own.figures) {
        for (const ending of ["csv", "svg", "png"]) {
          assert.ok(files.includes(`${name}.${ending}`), `${name}.${ending} in ${files}`);
          assert.ok(statSync(join(REPORT_FOLDER, own.name, "figures", `${name}.${ending}`)).size > 100, `${name}.${ending}`);
        }
      }
    });

    test("looks as it is in the docs", async () => {
      await page.evaluate(() => scrollTo(0, 0));
      await screenshot(page, own.name);
      if (own.matrix) {
        await page.locator("#alike").evaluate((node) => node.scrollIntoView());
        await screenshot(page, `${own.name}-alike`);
      }
    });
  });
}
