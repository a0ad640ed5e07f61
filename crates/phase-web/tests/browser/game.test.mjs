// The two-player game in two browser windows: a whole game by key presses, absence, a lost connection, a killed server.
import assert from "node:assert/strict";
import { mkdtemp, readFile, readdir, rm } from "node:fs/promises";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { listen, start, violations } from "./server.mjs";
import { launch } from "./site.mjs";

const AXE = await readFile(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const OPTIONS = ["--max-steps", "16", "--rounds", "2", "--simulations", "50", "--particles", "10"];
let server, browser, folder;
const complaints = [];

before(async () => {
  folder = await mkdtemp(join(tmpdir(), "phase-game-"));
  server = await start("--out", folder, ...OPTIONS);
  browser = await launch();
});

after(async () => {
  await browser?.close();
  await server?.stop("SIGTERM");
  await rm(folder, { recursive: true, force: true });
});

/** A window of its own: pages of one window share focus and storage. */
async function visit(path, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1100, height: 860 }, ...options });
  const page = await context.newPage();
  listen(page, complaints);
  await page.goto(path.startsWith("http") ? path : server.address + path);
  return page;
}

const message = (page, text) =>
  page.waitForFunction((wanted) => document.getElementById("message").textContent.includes(wanted), text, { timeout: 30_000 });
const recordings = async () => (await readdir(join(folder, "events"))).sort();
const picture = (page) => page.evaluate(() => document.getElementById("arena").toDataURL());
const screenshot = (page, name) =>
  process.env.PHASE_SCREENSHOTS ? page.screenshot({ path: join(process.env.PHASE_SCREENSHOTS, `${name}.png`), fullPage: true }) : null;

/** Both players of a new game. */
async function two() {
  const host = await visit("play/");
  await host.click("#lobby button[type=submit]");
  await message(host, "Waiting for the other player");
  const link = await host.inputValue("#link");
  const guest = await visit(link);
  await message(guest, "Read this");
  await message(host, "Read this");
  return [host, guest];
}

async function ready(...pages) {
  for (const page of pages) await page.click("#ready");
}

test("the first page leads to everything", async () => {
  const page = await visit("");
  assert.deepEqual(await violations(page, AXE), []);
  assert.deepEqual(await page.$$eval(".doors > li:not([hidden]) > a", (links) => links.map((link) => link.getAttribute("href"))), ["playground/", "play/"]);
  await page.click("text=Play");
  await page.waitForSelector("#lobby:not([hidden])");
  assert.deepEqual(await violations(page, AXE), []);
  await page.context().close();
});

test("two people play a whole game by key presses", async () => {
  const [host, guest] = await two();
  await screenshot(host, "game-practice");
  await ready(host, guest);
  await message(host, "Practice: try all keys");
  const before = await picture(host);
  await host.keyboard.down("ArrowUp");
  await guest.keyboard.down("KeyQ");
  await host.waitForTimeout(1200);
  assert.notEqual(await picture(host), before);
  await host.keyboard.up("ArrowUp");
  await guest.keyboard.up("KeyQ");
  await ready(host, guest);
  for (const round of [1, 2]) {
    for (const page of [host, guest]) {
      await message(page, "Read your goal");
      assert.match(await page.textContent("#told"), /You are the (red|green) agent\..*(goal|Help|Keep)/);
      assert.equal(await page.textContent("#round"), `Round ${round} of 2`);
    }
    if (round === 1) assert.deepEqual(await violations(host, AXE), []);
    await ready(host, guest);
    await message(host, "Play!");
    await host.keyboard.down("ArrowUp");
    await guest.keyboard.press("ArrowLeft");
    await guest.keyboard.press("Space");
    await host.waitForTimeout(800);
    if (round === 1) await screenshot(guest, "game-round");
    await host.keyboard.up("ArrowUp");
  }
  await message(host, "All rounds are played");
  await message(guest, "All rounds are played");
  await screenshot(host, "game-over");
  const files = await recordings();
  assert.equal(files.length, 2);
  for (const file of files) {
    const { format, events: [event] } = JSON.parse(await readFile(join(folder, "events", file), "utf8"));
    assert.equal(format, "phase-events/1");
    assert.deepEqual(event.agents.map(({ controller }) => controller), ["human", "human"]);
    const done = event.actions.flat();
    assert.ok(done.includes("up") && done.includes("left"), JSON.stringify(event.actions));
    assert.ok(done.includes("attach") || done.includes("detach"));
  }
  for (const page of [host, guest]) await page.context().close();
});

test("absence pauses, and whoever comes back goes on", async () => {
  const [host, guest] = await two();
  await ready(host, guest);
  await message(host, "Practice");
  const { context, url } = { context: guest.context(), url: guest.url() };
  await context.close();
  await message(host, "The other player is away");
  assert.equal(await host.textContent("#overlay"), "Paused");
  const back = await visit(url);
  await message(back, "Practice");
  await message(host, "Practice");
  // A tab in the background.
  await back.evaluate(() => {
    Object.defineProperty(document, "hidden", { configurable: true, get: () => true });
    document.dispatchEvent(new Event("visibilitychange"));
  });
  await message(host, "The other player is away");
  await back.evaluate(() => {
    Object.defineProperty(document, "hidden", { configurable: true, get: () => false });
    document.dispatchEvent(new Event("visibilitychange"));
  });
  await message(host, "Practice");
  // The same player in another tab.
  const other = await visit(url);
  await message(other, "Practice");
  await message(back, "another tab");
  await other.click("#leave");
  await message(host, "A player has left");
  for (const page of [host, back, other]) await page.context().close();
});

test("a killed server loses no step, and the pages find it again", async () => {
  const [host, guest] = await two();
  await ready(host, guest);
  await message(host, "Practice");
  await ready(host, guest);
  await message(host, "Read your goal");
  await ready(host, guest);
  await message(host, "Play!");
  await guest.keyboard.down("ArrowDown");
  await host.waitForFunction(() => document.getElementById("clock").value >= 4);
  const address = new URL(server.address);
  await server.stop("SIGKILL");
  const seen = await host.evaluate(() => document.getElementById("clock").value);
  complaints.length = 0; // Browsers tell of lost connections.
  await message(host, "trying again");
  const journals = await Promise.all((await readdir(join(folder, "rooms"))).map((file) => readFile(join(folder, "rooms", file), "utf8")));
  const open = journals.filter((text) => !text.includes('"entry":"over"'));
  assert.equal(open.length, 1);
  const round = open[0].slice(open[0].lastIndexOf('"entry":"began"'));
  assert.ok(round.split('"entry":"step"').length - 1 >= seen, "every step that was seen is in the journal");
  server = await start("--out", folder, ...OPTIONS, "--listen", address.host);
  await message(host, "Play!");
  await guest.keyboard.up("ArrowDown");
  await message(host, "Read your goal");
  const before = await recordings();
  assert.equal(before.length, 3);
  await host.click("#leave");
  await message(guest, "A player has left");
  complaints.length = 0;
  for (const page of [host, guest]) await page.context().close();
});

test("one person plays against a mind, with keys on the screen of a phone", async () => {
  const page = await visit("play/", { viewport: { width: 390, height: 800 }, hasTouch: true });
  await page.check("input[value=mind]");
  await page.check("input[value=all]");
  await page.tap("#lobby button[type=submit]");
  await message(page, "Read this");
  assert.deepEqual(await violations(page, AXE), []);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
  assert.ok(!wide, "nothing lies beyond the side of a phone");
  const inSight = (selector) => page.$eval(selector, (element) => element.getBoundingClientRect().bottom <= innerHeight);
  assert.ok(await inSight("#ready"), "the button that begins is in sight");
  await ready(page);
  await message(page, "Practice");
  assert.ok(await inSight("#pad .wide"), "the keys are in sight while one plays");
  await page.tap("#pad button[data-key=ArrowUp]");
  await ready(page);
  await message(page, "Read your goal");
  await ready(page);
  await message(page, "Play!");
  await screenshot(page, "game-phone");
  assert.ok(await inSight("#pad .wide"), "the keys are in sight in a round");
  await page.tap("#pad button[data-key=KeyQ]");
  await message(page, "The round is over: your goal was");
  const files = await recordings();
  const played = await Promise.all(files.map(async (file) => JSON.parse(await readFile(join(folder, "events", file), "utf8")).events[0]));
  const mixed = played.filter(({ agents }) => agents.filter(({ controller }) => controller === "human").length === 1);
  assert.equal(mixed.length, 1);
  await page.click("#leave");
  await page.context().close();
});

test("rubbish is refused in words", async () => {
  const page = await visit(`play/#${"0".repeat(32)}`);
  await message(page, "There is no such game");
  await page.context().close();
  complaints.length = 0;
});

test("the person in charge sees the games", async () => {
  const page = await visit("admin/");
  await page.fill("#token", "wrong");
  await page.click("#enter button");
  await message(page, "needs the admin token");
  complaints.length = 0; // Browsers tell of refused requests.
  await page.fill("#token", server.token);
  await page.click("#enter button");
  await page.waitForSelector("#rooms table");
  await page.click("#open");
  await page.waitForSelector("#links a");
  assert.equal(await page.locator("#links a").count(), 2);
  assert.deepEqual(await violations(page, AXE), []);
  await screenshot(page, "admin");
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#download")]);
  const { format, events } = JSON.parse(await readFile(await download.path(), "utf8"));
  assert.equal(format, "phase-events/1");
  assert.equal(events.length, (await recordings()).length);
  // Rooms of games that have just ended may still be there.
  const [, room] = (await page.textContent("#links li")).match(/Room (\w+)/);
  await page.click(`#rooms tr:has-text("${room}") button`);
  await page.waitForFunction((name) => !document.getElementById("rooms").textContent.includes(name), room, { timeout: 10_000 });
  await page.context().close();
});

test("the browser had nothing to complain of", () => {
  assert.deepEqual(complaints, []);
});
