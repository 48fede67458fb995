// Opens the report, the papers' page and the page of a simulation in Chromium, wide and narrow, light and dark, and tries what a reader does:
// contents, folds, looking closer. Fails with a list of what does not hold.
//
//   node report.mjs REPORT.html PAPERS.html SIMULATION.html SCREENSHOTS
//
// needs playwright-core beside it and /usr/bin/chromium.
import { mkdirSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [report, papers, simulation, shots] = process.argv.slice(2).map((path) => resolve(path));
const SCREEN = 900;
const SCREENS = 12;
const SMALLEST_TEXT = 10;
const CONTRAST = 4.5;
const ARGUMENTS = [
  "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync",
];

const problems = [];
const counts = {};
const require = (holds, what) => {
  if (!holds) problems.push(what);
};

/** In the page: labels over each other, cut off, too small or too pale, in every picture that is seen. */
const labels = ([smallest, contrast]) => {
  const found = [];
  let count = 0;
  const light = (colour) => {
    const [red, green, blue] = colour.match(/[\d.]+/g).map((part) => {
      const share = part / 255;
      return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
    });
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
  };
  const paper = light(getComputedStyle(document.body).backgroundColor);
  for (const svg of document.querySelectorAll("svg")) {
    const frame = svg.getBoundingClientRect();
    if (frame.width === 0) continue;
    const scale = svg.viewBox.baseVal.width ? frame.width / svg.viewBox.baseVal.width : 1;
    const name = svg.closest("figure")?.id || svg.getAttribute("aria-label") || "picture";
    const texts = [...svg.querySelectorAll("text")].filter((text) => text.textContent.trim());
    const boxes = texts.map((text) => text.getBoundingClientRect());
    count += texts.length;
    texts.forEach((text, index) => {
      const box = boxes[index], words = text.textContent.trim();
      if (box.left < frame.left - 2 || box.right > frame.right + 2 || box.top < frame.top - 3 || box.bottom > frame.bottom + 3)
        found.push(`${name}: "${words}" is cut off`);
      const size = parseFloat(getComputedStyle(text).fontSize) * scale;
      if (size < smallest) found.push(`${name}: "${words}" is ${size.toFixed(1)} px high`);
      const own = light(getComputedStyle(text).fill);
      const ratio = (Math.max(own, paper) + 0.05) / (Math.min(own, paper) + 0.05);
      if (ratio < contrast) found.push(`${name}: "${words}" has a contrast of ${ratio.toFixed(1)}`);
      for (let other = 0; other < index; other += 1) {
        const before = boxes[other];
        const across = Math.min(box.right, before.right) - Math.max(box.left, before.left);
        // A box has room above and below its letters.
        const up = Math.min(box.bottom, before.bottom) - Math.max(box.top, before.top);
        if (across > 1 && up > 0.25 * Math.min(box.height, before.height) && up > 1)
          found.push(`${name}: "${words}" stands over "${texts[other].textContent.trim()}"`);
      }
    });
  }
  return [found, count];
};

const scrolls = () => document.documentElement.scrollWidth > document.documentElement.clientWidth + 1;

const open = async (browser, file, width, scheme, where) => {
  const page = await browser.newPage({ viewport: { width, height: SCREEN }, colorScheme: scheme });
  page.on("console", (message) => require(message.type() !== "error", `${where}: console: ${message.text()}`));
  page.on("pageerror", (error) => require(false, `${where}: ${error.message}`));
  page.on("request", (request) => require(!/^https?:/.test(request.url()), `${where}: asks for ${request.url()}`));
  await page.goto(pathToFileURL(file).href);
  return page;
};

/** A page that is shown only later, as in a folded frame, draws when it gets its room. */
const later = async (browser) => {
  const where = "simulation in a frame without width";
  const page = await open(browser, simulation, 390, "light", where);
  await page.evaluate(() => {
    const host = document.getElementById("panels");
    host.style.width = "0px";
  });
  await page.waitForTimeout(200);
  await page.evaluate(() => { document.getElementById("panels").style.width = "300px"; });
  await page.waitForTimeout(200);
  const wide = await page.locator("#panels svg").first().evaluate((svg) => svg.viewBox.baseVal.width);
  require(wide === 300, `${where}: drawn ${wide} px wide for 300`);
  await page.close();
};

const contents = async (page, width, where) => {
  const narrow = width < 960;
  const links = await page.locator("nav a").all();
  require(links.length >= 9, `${where}: ${links.length} links in the contents`);
  for (const [index, link] of links.entries()) {
    if (index % 3 !== 1) continue;
    if (narrow) await page.locator("nav > button").click();
    const id = (await link.getAttribute("href")).slice(1);
    await link.click();
    const state = await page.evaluate((id) => {
      const target = document.getElementById(id);
      return target && { open: target.open, top: target.getBoundingClientRect().top, nav: document.querySelector("nav").getBoundingClientRect().top };
    }, id);
    require(state, `${where}: #${id} leads nowhere`);
    if (!state) continue;
    require(state.open, `${where}: #${id} stays folded`);
    require(state.top > -5 && state.top < SCREEN, `${where}: #${id} is out of view at ${state.top}`);
    require(Math.abs(state.nav) < 1, `${where}: the contents left the window at #${id}`);
    if (narrow) require(!(await page.locator("nav .links").isVisible()), `${where}: the menu stays open`);
  }
};

const folds = async (page, where) => {
  const section = page.locator("details.section").last();
  const before = await section.evaluate((each) => each.open);
  await section.locator("> summary").click();
  require((await section.evaluate((each) => each.open)) !== before, `${where}: a section does not fold`);
};

const look = async (page, where) => {
  const [found, count] = await page.evaluate(labels, [SMALLEST_TEXT, CONTRAST]);
  counts[where] = count;
  for (const each of found) require(false, `${where}: ${each}`);
};

const reading = async (browser, name, width, scheme) => {
  const where = `${name}, ${width} px, ${scheme}`;
  const page = await open(browser, { report, papers }[name], width, scheme, where);
  const screens = (await page.evaluate(() => document.documentElement.scrollHeight)) / SCREEN;
  counts[`${where}, screens`] = Number(screens.toFixed(1));
  if (name === "report" && width >= 960) require(screens <= SCREENS, `${where}: ${screens.toFixed(1)} screens before anything is unfolded`);
  require(!(await page.evaluate(scrolls)), `${where}: the page scrolls sideways`);
  await page.screenshot({ path: `${shots}/${name}-${width}-${scheme}.png`, fullPage: true });
  await contents(page, width, where);
  await folds(page, where);
  await page.evaluate(() => { for (const each of document.querySelectorAll("details")) each.open = true; });
  require(!(await page.evaluate(scrolls)), `${where}: unfolded, the page scrolls sideways`);
  await look(page, where);
  for (const picture of ["friction_over_a_manoeuvre", "lin_figures_3_24", "memory_loops", "curvature_figure_9"]) {
    const figure = page.locator(`figure[id^="figure-"][id*="${picture}"]`);
    if (await figure.count()) await figure.first().screenshot({ path: `${shots}/${picture}-${width}-${scheme}.png` });
  }
  await page.close();
};

const looking = async (browser, width, scheme) => {
  const where = `simulation, ${width} px, ${scheme}`;
  const page = await open(browser, simulation, width, scheme, where);
  await look(page, where);
  require(!(await page.evaluate(scrolls)), `${where}: the page scrolls sideways`);
  const lines = () => page.locator("#panels path").first().getAttribute("d");
  const before = await lines();
  const box = await page.locator("#panels svg").first().boundingBox();
  await page.mouse.move(box.x + box.width * 0.4, box.y + 100);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.6, box.y + 100, { steps: 4 });
  await page.mouse.up();
  require((await lines()) !== before, `${where}: dragging over a stretch shows nothing closer`);
  await look(page, `${where}, closer`);
  await page.screenshot({ path: `${shots}/simulation-${width}-${scheme}.png`, fullPage: true });
  await page.locator("button").click();
  require((await lines()) === before, `${where}: the button does not show everything`);
  await page.close();
};

mkdirSync(shots, { recursive: true });
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ARGUMENTS });
for (const width of [1400, 390]) {
  for (const scheme of ["light", "dark"]) {
    for (const name of ["report", "papers"]) await reading(browser, name, width, scheme);
    await looking(browser, width, scheme);
  }
}
await later(browser);
await browser.close();
for (const [where, count] of Object.entries(counts)) console.log(`${where}: ${count}${where.endsWith("screens") ? "" : " labels"}`);
for (const problem of problems) console.error(problem);
console.log(problems.length ? `${problems.length} problems` : "no label over another, none cut off, nothing asked of a network");
process.exitCode = problems.length ? 1 : 0;
