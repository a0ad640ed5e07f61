// The playground in a browser: run, scrub, edit, take over, share, save and open, without a complaint of the browser or of axe.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";
import { after, before, test } from "node:test";
import { launch, serve } from "./site.mjs";

const AXE = createRequire(import.meta.url).resolve("axe-core/axe.min.js");
let site, browser, page;
const complaints = [];

before(async () => {
  const folder = process.env.PHASE_PLAYGROUND_SITE;
  assert.ok(folder, "PHASE_PLAYGROUND_SITE names the folder of the playground");
  site = await serve(folder);
  browser = await launch();
  page = await browser.newPage({ viewport: { width: 1280, height: 900 } });
  page.on("console", (message) => { if (["error", "warning"].includes(message.type())) complaints.push(message.text()); });
  page.on("pageerror", (error) => complaints.push(error.message));
});

after(async () => {
  await browser?.close();
  site?.close();
});

const seconds = async () => Number.parseFloat(await page.textContent("#clock"));
const until = (text) => page.waitForFunction((wanted) => document.getElementById("message").textContent.includes(wanted), text);

async function begin(hash = "") {
  await page.goto("about:blank");
  await page.goto(site.address + hash);
  await page.waitForSelector("#run:not([disabled])");
  await page.fill("#simulations", "100");
  await page.locator("#simulations").blur();
}

async function saved() {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save-event")]);
  return JSON.parse(await readFile(await download.path(), "utf8"));
}

test("an event runs, and is thought about and watched", async () => {
  await begin();
  await page.click("#run");
  await page.waitForFunction(() => Number.parseFloat(document.getElementById("clock").textContent) > 3);
  await page.waitForSelector("#posterior meter");
  await page.click("#run");
  const relation = await page.$$eval("#posterior > .share meter", (meters) => meters.map((meter) => meter.value));
  assert.equal(relation.length, 3);
  assert.ok(Math.abs(relation.reduce((a, b) => a + b) - 1) < 1e-6);
  assert.match(await page.textContent("#thoughts"), /subgoal: (On|Attach|Close|Stay|Touch|not)/);
  await page.check("input[name=mind][value='1']");
  if (process.env.PHASE_SCREENSHOTS) await page.screenshot({ path: `${process.env.PHASE_SCREENSHOTS}/playground.png`, fullPage: true });
});

test("time can be set", async () => {
  const end = await seconds();
  assert.ok(end > 3);
  await page.locator("#time").evaluate((slider) => { slider.value = 5; slider.dispatchEvent(new Event("input")); });
  await page.waitForFunction(() => document.getElementById("clock").textContent === "0.3 s");
});

test("an event is saved, and opened again", async () => {
  const document = await saved();
  assert.equal(document.format, "phase-events/1");
  const steps = document.events[0].actions.length;
  assert.ok(steps > 10);
  await page.setInputFiles("#open", { name: "event.json", mimeType: "application/json", buffer: Buffer.from(JSON.stringify(document)) });
  await until("an event from a file");
  assert.equal(Number(await page.getAttribute("#time", "max")), 5 * steps);
});

test("an event without labels is opened, and watched", async () => {
  await begin();
  await page.click("#run");
  await page.waitForFunction(() => Number.parseFloat(document.getElementById("clock").textContent) > 2);
  await page.click("#run");
  const { format, events: [{ id, layout, walls, agents, objects, trajectory }] } = await saved();
  const sizes = (bodies) => bodies.map(({ size_level, radius }) => ({ size_level, radius }));
  const event = { id, layout, walls, agents: sizes(agents), objects: sizes(objects), trajectory };
  const file = Buffer.from(JSON.stringify({ format, events: [event] }));
  await page.setInputFiles("#open", { name: "event.json", mimeType: "application/json", buffer: file });
  await until("an event without labels");
  await page.locator("#time").evaluate((slider) => { slider.value = slider.max; slider.dispatchEvent(new Event("input")); });
  await page.waitForSelector("#posterior meter");
});

test("a video is dropped, tracked and watched", { skip: !process.env.PHASE_VIDEO && "PHASE_VIDEO names no video" }, async () => {
  await begin();
  const bytes = (await readFile(process.env.PHASE_VIDEO)).toString("base64");
  await page.evaluate((bytes) => {
    const dropped = new DataTransfer();
    dropped.items.add(new File([Uint8Array.from(atob(bytes), (letter) => letter.charCodeAt(0))], "a film.mp4", { type: "video/mp4" }));
    document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: dropped, bubbles: true, cancelable: true }));
  }, bytes);
  await page.waitForFunction(() => /found in it|wrong/.test(`${document.getElementById("message").textContent} ${document.getElementById("message").className}`), null, { timeout: 120_000 });
  assert.match(await page.textContent("#message"), /^a-film: a video, with what was found in it\. Restart/);
  const steps = Number(await page.getAttribute("#time", "max")) / 5;
  assert.ok(steps >= 8 && steps <= 11, `${steps} steps`);
  await page.click("#run");
  await page.waitForFunction(() => Number.parseFloat(document.getElementById("clock").textContent) > 1);
  await page.waitForSelector("#posterior meter");
  if (process.env.PHASE_SCREENSHOTS) await page.screenshot({ path: `${process.env.PHASE_SCREENSHOTS}/film.png`, fullPage: true });
  await page.click("#restart");
});

test("a video that is none is refused in a sentence", async () => {
  await page.setInputFiles("#open", { name: "rubbish.mp4", mimeType: "video/mp4", buffer: Buffer.from("no video") });
  await until("rubbish.mp4: this browser cannot decode it");
});

test("rubbish is refused in a sentence", async () => {
  for (const rubbish of ["", "{}", "[1, 2]", '{"format": "phase-events/1", "events": [{}]}']) {
    await page.setInputFiles("#open", { name: "rubbish.json", mimeType: "application/json", buffer: Buffer.from(rubbish) });
    await until("rubbish.json: ");
    assert.ok(await page.locator("#message.wrong").count());
  }
  await begin("#rubbish");
});

test("bodies are dragged, and settings change the scene", async () => {
  await begin();
  const field = page.locator("[data-field=x-0]");
  const before = Number(await field.inputValue());
  const y = Number(await page.locator("[data-field=y-0]").inputValue());
  const box = await page.locator("#picture").boundingBox();
  const scale = box.width / 24.5;
  const place = (x, height) => [box.x + box.width / 2 + (x - 16) * scale * 0.9, box.y + box.height / 2 - (height - 12) * scale * 0.9];
  await page.mouse.move(...place(before, y));
  await page.mouse.down();
  const [x, height] = place(before, y);
  for (const shift of [6, 12, 18]) await page.mouse.move(x - shift, height + shift / 3);
  await page.mouse.up();
  assert.notEqual(Number(await field.inputValue()), before);
  await field.fill("100");
  await field.blur();
  assert.ok(await page.locator("#message.wrong").count());
  await page.selectOption("#objects", "2");
  await page.selectOption("[data-field=attitude-0]", "0");
  await page.waitForFunction(() => document.querySelectorAll("#sizes label").length === 6);
});

test("whoever helps has the other's goal", async () => {
  await begin();
  await page.selectOption("[data-field=attitude-0]", "0");
  await page.selectOption("[data-field=attitude-1]", "0");
  assert.ok(await page.locator("[data-field=goal-1]").isEnabled());
  const touch = await page.locator("[data-field=goal-0] option").filter({ hasText: "to touch the other" }).getAttribute("value");
  await page.selectOption("[data-field=goal-0]", touch);
  await page.selectOption("[data-field=attitude-1]", "-1");
  assert.ok(await page.locator("[data-field=goal-1]").isDisabled());
  const goal = JSON.parse(await page.locator("[data-field=goal-1]").inputValue());
  assert.deepEqual([goal.kind, goal.sign], ["touch", -1]);
});

test("a link holds the scene", async () => {
  await page.click("#share");
  await page.waitForFunction(() => location.hash.length > 10);
  const [hash, x] = [await page.evaluate(() => location.hash), await page.locator("[data-field=x-0]").inputValue()];
  await begin(hash);
  assert.equal(await page.locator("[data-field=x-0]").inputValue(), x);
});

test("an agent is played by keys", async () => {
  await begin();
  await page.selectOption("[data-field=control-0]", "keys");
  await page.click("#run");
  await page.keyboard.down("ArrowUp");
  await page.waitForTimeout(1500);
  await page.keyboard.up("ArrowUp");
  await page.keyboard.down("KeyQ");
  await page.waitForTimeout(800);
  await page.keyboard.up("KeyQ");
  await page.keyboard.press("Space");
  await page.waitForTimeout(800);
  await page.click("#run");
  const { actions } = (await saved()).events[0];
  const own = actions.map(([first]) => first);
  for (const action of ["up", "turnleft", "attach", "stop"]) assert.ok(own.includes(action), `${action} in ${own}`);
});

test("nothing stands in the way of anybody", async () => {

  await page.evaluate(await readFile(AXE, "utf8"));
  const { violations } = await page.evaluate(() => window.axe.run());
  assert.deepEqual(violations.map(({ id, nodes }) => [id, nodes.map((node) => node.html)]), []);
});

test("the browser has nothing to complain of", () => {
  assert.deepEqual(complaints.filter((text) => !text.includes("axe")), []);
});

test("an event made here is the one that the program makes", { skip: !process.env.PHASE && "PHASE does not name the program" }, async () => {
  await begin();
  await page.selectOption("#kind", "hindering");
  await page.waitForSelector("#run:not([disabled])");
  await page.fill("#simulations", "300");
  await page.locator("#simulations").blur();
  await page.click("#run");
  await page.waitForFunction(() => Number.parseFloat(document.getElementById("clock").textContent) > 5);
  await page.click("#run");
  const { events: [here] } = await saved();
  const rows = (tracks) => tracks.map(([first]) => [first]);
  const { columns, agents, objects } = here.trajectory;
  const scene = {
    ...Object.fromEntries(["id", "layout", "agents", "objects", "event", "seed"].map((name) => [name, here[name]])),
    trajectory: { columns, agents: rows(agents), objects: rows(objects) },
  };
  const folder = await mkdtemp(join(tmpdir(), "phase-same-"));
  await writeFile(join(folder, "scene.json"), JSON.stringify({ format: "phase-events/1", events: [scene] }));
  const options = ["--events", join(folder, "scene.json"), "--out", join(folder, "out"), "--no-video", "--quiet"];
  const effort = ["--simulations", "300", "--max-steps", String(here.actions.length)];
  await promisify(execFile)(process.env.PHASE, ["simulate", ...options, ...effort]);
  const { events: [there] } = JSON.parse(await readFile(join(folder, "out", `${here.id}.json`), "utf8"));
  await rm(folder, { recursive: true });
  assert.ok(here.actions.length >= 20);
  for (const name of ["seed", "actions", "subgoals", "values", "substeps", "thoughts", "trajectory"]) {
    assert.deepEqual(here[name], there[name], name);
  }
});
