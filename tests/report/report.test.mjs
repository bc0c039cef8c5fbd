// SPDX-License-Identifier: MIT
// The page of dynid's reports in headless Chromium, as a reader uses it.
//   DYNID, RECORD   the programs                   REPORT_FOLDER  where recordings and reports are made
//   DYNGEN_SOURCES  the project                    and what browser.mjs reads
import assert from "node:assert/strict";
import { existsSync, readFileSync, readdirSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { pathToFileURL } from "node:url";
import { assertSoon, htmlFaults, kMostBytes, kMostSeconds, open, painted, picture, screenshot, secondsToDrawn, widthOnPhone } from "./browser.mjs";
import { kCases, kEvil, makeReport } from "./reports.mjs";

const { DYNID, RECORD, REPORT_FOLDER, SCREENSHOTS } = process.env;
const kSteps = ["Where", "What", "How much", "Model", "Proof", "What changed", "What next"];
const kAlways = ["verdict", "heldout", "certificate", "undecidable", "parameters", "structure", "condition", "noise", "origin"];

for (const own of kCases) {
  describe(`the report "${own.name}"`, () => {
    let path, page, faults, requests;
    before(async () => {
      path = makeReport(own, { dynid: DYNID, record: RECORD }, REPORT_FOLDER);
      ({ page, faults, requests } = await open(path));
    });
    after(() => page?.close());

    test("is what the diagnosis found", () => {
      const findings = JSON.parse(readFileSync(join(REPORT_FOLDER, own.name, "findings.json"), "utf8"));
      assert.equal(findings.verdict, own.verdict);
      assert.equal(findings.findings.length, own.findings);
      // what has a test against it is said to be uncertain, and explains nothing
      const objected = findings.findings.filter(({ probability }) => probability <= 0.5);
      assert.equal(objected.length, own.uncertain ?? 0);
    });

    test("has every section, in order", async () => {
      const sections = await page.locator("main > section").evaluateAll((all) => all.map((section) => section.id));
      const found = Array.from({ length: own.findings }, (_, i) => `finding-${i + 1}`);
      assert.deepEqual(sections.slice(0, 1 + own.findings), ["verdict", ...found]);
      for (const id of kAlways) assert.ok(sections.includes(id), `${id} in ${sections}`);
      assert.equal(sections.includes("unexplained"), own.verdict === "unexplained_structure");
      for (const id of found) {
        const words = await page.locator(`#${id} .word`).allTextContents();
        assert.deepEqual(words, kSteps);
        assert.ok(await page.locator(`#${id} math`).count() > 0, "a formula");
        assert.equal(await page.locator(`#${id} figure.chart`).count(), 3);
      }
      const titles = await page.locator("main > section h2").allTextContents();
      assert.equal(titles.filter((title) => title.includes("Uncertain: ")).length, own.uncertain ?? 0);
      const links = await page.locator("nav a").evaluateAll((all) => all.map((link) => link.getAttribute("href").slice(1)));
      assert.deepEqual(links, sections);
      assert.ok((await page.locator("#origin pre").first().textContent()).startsWith("dynid diagnose "));
    });

    test("shows its verdict, the arm and bars on the first screen", async () => {
      for (const selector of [".verdict", "svg.arm", ".barfigure .groups"]) {
        const box = await page.locator(selector).first().boundingBox();
        assert.ok(box && box.y >= 0 && box.y + box.height <= 720, `${selector} ends at ${box?.y + box?.height}`);
      }
      assert.equal(await page.locator("svg.arm .joint").count(), own.joints);
      assert.equal(await page.locator(".group").count(), own.joints);
      assert.equal(await page.locator("svg.arm .joint.marked").count() > 0, own.verdict !== "clean");
    });

    test("has drawn all its charts", async () => {
      const canvases = await painted(page);
      assert.ok(canvases.length >= 2 * own.joints, `${canvases.length} canvases`);
      for (const { id, pixels, colours } of canvases) {
        assert.ok(pixels > 2000 && colours >= 4, `${id}: ${pixels} pixels of ${colours} colours`);
      }
    });

    test("zooms by dragging, keys and buttons, and goes back", async () => {
      const figure = page.locator("figure.chart").first();
      await figure.scrollIntoViewIfNeeded();
      const whole = await picture(figure);
      const reset = figure.getByRole("button", { name: /^show all/ });
      assert.ok(await reset.isDisabled());
      const box = await figure.locator(".u-over").first().boundingBox();
      await page.mouse.move(box.x + 0.3 * box.width, box.y + 0.5 * box.height);
      await page.mouse.down();
      await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.5 * box.height, { steps: 5 });
      await page.mouse.up();
      await assertSoon(async () => !(await reset.isDisabled()), "dragging zooms");
      assert.notEqual(await picture(figure), whole);
      await reset.click();
      await assertSoon(async () => (await reset.isDisabled()) && (await picture(figure)) === whole, "reset shows all");
      await figure.locator(".plots").focus();
      await page.keyboard.press("+");
      await assertSoon(async () => !(await reset.isDisabled()), "+ zooms");
      const zoomed = await picture(figure);
      await page.keyboard.press("ArrowRight");
      await assertSoon(async () => (await picture(figure)) !== zoomed, "arrows move");
      await page.keyboard.press("0");
      await assertSoon(async () => (await picture(figure)) === whole, "0 shows all");
    });

    test("is reached and read without a mouse", async () => {
      await page.evaluate(() => { document.activeElement?.blur(); scrollTo(0, 0); });
      const reached = new Set();
      for (let i = 0; i < 300 && !(reached.has("plots") && reached.has("arm") && reached.has("A")); ++i) {
        await page.keyboard.press("Tab");
        reached.add(await page.evaluate(() => document.activeElement.getAttribute("class") || document.activeElement.tagName));
      }
      for (const name of ["plots", "arm", "A"]) assert.ok(reached.has(name), `${name} in ${[...reached]}`);
      const numbers = page.locator("figure.chart details.numbers").first();
      await numbers.locator("summary").click();
      await assertSoon(async () => (await numbers.locator("tbody tr").count()) >= 10, "the numbers are shown");
      const label = await page.locator("figure.chart .plots").first().getAttribute("aria-label");
      assert.match(label, / from .* to /);
    });

    test("needs no network and says nothing", async () => {
      assert.deepEqual(requests, [pathToFileURL(path).href]);
      const blocked = await page.evaluate(() => fetch("https://example.org/").then(() => false, () => true));
      assert.ok(blocked, "its policy forbids requests");
      faults = faults.filter((fault) => !fault.includes("https://example.org/"));
      assert.deepEqual(faults, []);
    });

    test("keeps what files are called as text", async () => {
      assert.equal(await page.locator("img").count(), 0);
      if (own.name === "one") assert.ok((await page.locator("#condition").textContent({ timeout: 2000 })).includes(kEvil));
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

    test("is dark where the reader's screen is, and light on paper", async () => {
      const colours = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
      const figure = page.locator("figure.chart").first();
      const light = await picture(figure);
      assert.equal(await colours(), "rgb(255, 255, 255)");
      await page.emulateMedia({ colorScheme: "dark" });
      await assertSoon(async () => (await picture(figure)) !== light, "charts are painted anew");
      assert.notEqual(await colours(), "rgb(255, 255, 255)");
      await page.emulateMedia({ colorScheme: "dark", media: "print" });
      assert.equal(await colours(), "rgb(255, 255, 255)");
      assert.ok(await page.locator("nav").isHidden());
      await page.emulateMedia({ colorScheme: "light", media: null });
      const paper = await page.pdf({ format: "A4", printBackground: true, margin: { top: "12mm", bottom: "12mm", left: "12mm", right: "12mm" } });
      assert.ok(paper.length > 30000, `${paper.length} bytes`);
      writeFileSync(join(REPORT_FOLDER, own.name, "report.pdf"), paper);
    });

    test("has its figures as files", () => {
      const files = readdirSync(join(REPORT_FOLDER, own.name, "figures"));
      const names = new Set(files.map((file) => file.replace(/\.\w+$/, "")));
      assert.ok(names.has("heldout-rms"));
      for (let i = 1; i <= own.findings; ++i) assert.ok(names.has(`finding-${i}-model-chart`), [...names].join());
      for (const name of names) {
        for (const ending of ["csv", "svg", "png"]) {
          assert.ok(statSync(join(REPORT_FOLDER, own.name, "figures", `${name}.${ending}`)).size > 100, `${name}.${ending}`);
        }
      }
    });

    test("looks as it is in the docs", async () => {
      await page.evaluate(() => scrollTo(0, 0));
      await screenshot(page, own.name);
      if (!SCREENSHOTS || own.name === "clean") return;
      const target = own.findings > 0 ? "#finding-1" : "#unexplained";
      await page.locator(target).evaluate((node) => node.scrollIntoView());
      await screenshot(page, `${own.name}-finding`);
      if (own.findings === 0) return;
      for (const part of ["model", "proof"]) {
        await page.locator(`#finding-1-${part}`).evaluate((node) => node.scrollIntoView());
        await screenshot(page, `${own.name}-${part}`);
      }
      if (own.name !== "two") return;
      const dark = await open(path, { colorScheme: "dark" });
      await dark.page.locator("#finding-2").evaluate((node) => node.scrollIntoView());
      await screenshot(dark.page, `${own.name}-dark`);
      await dark.page.close();
    });
  });
}

/** As a recording of a million samples of seven joints makes it: all charts at their budget. */
test("a report at its largest opens as quickly", async (t) => {
  const source = join(REPORT_FOLDER, "two/report.html");
  assert.ok(existsSync(source));
  const html = readFileSync(source, "utf8");
  const begin = html.indexOf('type="application/json">') + 'type="application/json">'.length;
  const end = html.indexOf("</script>", begin);
  const report = JSON.parse(html.slice(begin, end));
  const heldout = report.sections.find((section) => section.id === "heldout").parts[0].blocks;
  const one = heldout.find((block) => block.type === "chart");
  const count = 6000, values = (phase) => Array.from({ length: count }, (_, i) => Number((20 * Math.sin(0.37 * i + phase)).toPrecision(5)));
  for (let j = 0; j < 7; ++j) {
    const chart = structuredClone(one);
    chart.id = `long-${j}`;
    const [torque, left] = chart.views[0].panels;
    torque.x = Array.from({ length: count }, (_, i) => Number((i / 6).toPrecision(7)));
    for (const panel of [torque, left]) {
      panel.series = panel.series.filter((series) => series.role !== "floor");
      panel.series.forEach((series, i) => { series.y = values(i + j); });
    }
    heldout.push(chart);
  }
  const finding = report.sections.find((section) => section.id === "finding-1");
  const clouds = finding.parts.flatMap((part) => part.blocks.filter((block) => block.type === "chart" && block.views.length > 0));
  for (let copy = 0; copy < 7; ++copy) {
    for (const chart of clouds) heldout.push({ ...chart, id: `${chart.id}-${copy}` });
  }
  const text = JSON.stringify(report).replaceAll("<", "\\u003c").replaceAll(">", "\\u003e").replaceAll("&", "\\u0026");
  const path = join(REPORT_FOLDER, "long.html");
  writeFileSync(path, html.slice(0, begin) + text + html.slice(end));
  const { page, faults } = await open(path);
  const seconds = await secondsToDrawn(path);
  t.diagnostic(`${statSync(path).size} bytes, drawn after ${seconds.toFixed(2)} s`);
  assert.ok(seconds < kMostSeconds, `${seconds} s`);
  assert.deepEqual(faults, []);
  await page.close();
});

test("the judge of blank charts sees one", async () => {
  const { page } = await open(join(REPORT_FOLDER, "clean/report.html"));
  await page.locator("figure.chart canvas").first().evaluate((canvas) => canvas.getContext("2d").clearRect(0, 0, 1e4, 1e4));
  assert.equal((await painted(page))[0].pixels, 0);
  await page.close();
});
