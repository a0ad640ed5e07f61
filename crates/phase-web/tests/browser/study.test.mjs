// Rating studies in a browser: each form from consent to the code with the keyboard alone, a reload, a lost server, withdrawal, a phone.
import assert from "node:assert/strict";
import { copyFile, mkdir, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { listen, start, violations } from "./server.mjs";
import { launch } from "./site.mjs";

const AXE = await readFile(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const PHONE = { viewport: { width: 360, height: 740 }, isMobile: true, hasTouch: true, deviceScaleFactor: 2 };
let server, browser, folder, options;
const complaints = [];

/** A study of three videos and a catch trial, all of them to be seen by everybody. */
async function study(form, more = {}) {
  const name = `try-${form}`;
  const stimuli = [];
  for (const k of [0, 1, 2]) {
    await copyFile(process.env.PHASE_VIDEO, join(folder, `${name}-${k}.mp4`));
    stimuli.push({ id: `event-${k}`, video: `${name}-${k}.mp4`, objects: 1 });
  }
  const config = {
    format: "phase-study/1", name, title: `<i>What</i> is ${form}?`, form, introduction: ["First <b>paragraph</b>.", "Second paragraph."], consent: ["Do you agree?"],
    instructions: ["Watch, then answer."], stimuli, raters_per_video: 50, videos_per_rater: 3,
    demographics: [
      { name: "age", text: "How old are you?", kind: "whole", from: 18, to: 120, required: true },
      { name: "screen", text: "What do you look at?", kind: "one", choices: ["a phone", "something larger"], required: true },
      { name: "notes", text: "Anything else?", kind: "text" },
    ],
    completion: { code: `<i>${form}</i>`, url: "https://example.org/done?cc=1" }, ...more,
  };
  const file = join(folder, `${config.name}.json`);
  await writeFile(file, JSON.stringify(config));
  return file;
}

before(async () => {
  assert.ok(process.env.PHASE_VIDEO, "PHASE_VIDEO names a video");
  folder = await mkdtemp(join(tmpdir(), "phase-study-"));
  await mkdir(join(folder, "out"));
  const files = [await study("interactions"), await study("goals"), await study("relation")];
  options = ["--out", join(folder, "out"), ...files.flatMap((file) => ["--study", file])];
  server = await start(...options);
  browser = await launch();
});

after(async () => {
  await browser?.close();
  await server?.stop("SIGTERM");
  await rm(folder, { recursive: true, force: true });
});

/** A rater with a browser of its own. */
async function visit(form, id, context = {}) {
  const page = await (await browser.newContext({ viewport: { width: 1000, height: 900 }, ...context })).newPage();
  listen(page, complaints);
  await page.goto(`${server.address}study/try-${form}/?PROLIFIC_PID=${id}`);
  return page;
}

const title = (page, text) => page.waitForFunction((wanted) => document.querySelector("h1")?.textContent.includes(wanted), text, { timeout: 30_000 });
const press = (page, name, key = "Enter") => page.getByRole("button", { name, exact: true }).press(key);
const nothingInTheWay = async (page) => assert.deepEqual(await violations(page, AXE), []);
const screenshot = (page, name) =>
  process.env.PHASE_SCREENSHOTS ? page.screenshot({ path: join(process.env.PHASE_SCREENSHOTS, `study-${name}.png`), fullPage: true }) : null;

/** From the first page to the first video, by keyboard. */
async function begin(page, form) {
  await title(page, `<i>What</i> is ${form}?`);
  assert.equal(await page.locator("main i, main b").count(), 0, "texts are text");
  assert.ok(await page.locator("#leave").isHidden());
  await nothingInTheWay(page);
  await press(page, "I agree to take part");
  await title(page, "About you");
  await press(page, "Continue");
  await page.getByRole("alert").getByText("Please answer: How old are you?").waitFor();
  assert.equal(await page.evaluate(() => document.activeElement.name), "age");
  await page.keyboard.type("17");
  await press(page, "Continue");
  await page.getByRole("alert").getByText("from 18 to 120").waitFor();
  await nothingInTheWay(page);
  await page.getByLabel("How old are you?").fill("30");
  await page.getByLabel("a phone").press("Space");
  await page.getByLabel("Anything else? (optional)").press("End");
  await page.keyboard.type("<img src=x>, \"=1+1\"");
  await page.keyboard.press("Enter");
  await title(page, "Instructions");
  await nothingInTheWay(page);
  await press(page, "Begin");
  await title(page, "Animation 1 of 3");
}

/** Watches the video of a page to its end; it is sped up, for nobody waits here. */
async function watch(page) {
  await page.evaluate(() => { document.querySelector("video").playbackRate = 8; });
  await press(page, "Play", "Space");
  await page.getByRole("button", { name: "Play again" }).waitFor({ timeout: 60_000 });
}

const ANSWERS = {
  async interactions(page) {
    assert.equal(await page.getByRole("checkbox").count(), 23);
    for (const label of ["helping", "following the lead (of another agent)"]) await page.getByLabel(label, { exact: true }).press("Space");
  },
  async goals(page) {
    await page.getByLabel("goal of the red agent").selectOption("light blue on green");
    await page.getByLabel("goal of the green agent").selectOption("help");
    await page.getByLabel("friendly").press("Space");
    await page.getByLabel("5, very likely").press("Space");
  },
  async relation(page) {
    await page.getByLabel("neutral").press("Space");
  },
};

for (const form of Object.keys(ANSWERS)) {
  test(`a rater answers the form ${form} with the keyboard`, async () => {
    const page = await visit(form, "keyboard");
    await begin(page, form);
    for (const trial of [1, 2, 3]) {
      await title(page, `Animation ${trial} of 3`);
      assert.equal(await page.evaluate(() => document.activeElement.tagName), "H1");
      await page.getByText("You can answer when the animation has ended.").waitFor();
      assert.equal(await page.locator(".phase-form").locator("input:enabled, select:enabled, button:enabled").count(), 0, "nothing can be answered yet");
      if (trial === 1) await nothingInTheWay(page);
      await watch(page);
      await ANSWERS[form](page);
      if (trial === 1) {
        await nothingInTheWay(page);
        await screenshot(page, form);
      }
      await press(page, "Continue");
    }
    await title(page, "Done");
    assert.equal(await page.textContent(".code"), `<i>${form}</i>`);
    assert.equal(await page.getByRole("link", { name: "Finish" }).getAttribute("href"), "https://example.org/done?cc=1");
    await nothingInTheWay(page);
    await page.context().close();
  });
}

test("a reload goes on in the middle, and so does another tab; another browser with the same address is somebody else", async () => {
  const page = await visit("relation", "reload");
  await begin(page, "relation");
  await watch(page);
  await ANSWERS.relation(page);
  await press(page, "Continue");
  await title(page, "Animation 2 of 3");
  await page.reload();
  await title(page, "Animation 2 of 3");
  assert.ok(await page.getByLabel("neutral").isDisabled());
  const stranger = await visit("relation", "reload");
  await title(stranger, "What");
  await stranger.context().close();
  const other = await page.context().newPage();
  listen(other, complaints);
  await other.goto(page.url());
  await title(other, "Animation 2 of 3");
  // The same trial answered otherwise in the other tab: the first answer stays, and both go on.
  await watch(page);
  await press(page, "Continue");
  await page.getByRole("alert").getByText("Please answer").waitFor();
  await watch(other);
  await ANSWERS.relation(page);
  await press(page, "Continue");
  await title(page, "Animation 3 of 3");
  const before = complaints.length;
  await other.getByLabel("adversarial").press("Space");
  await press(other, "Continue");
  await title(other, "Animation 3 of 3");
  await other.getByText("this was answered before").waitFor();
  // A browser complains of a refusal, though the page knows what to do.
  assert.match(complaints.splice(before).join(), /^[^,]*409[^,]*$/);
  await page.context().close();
});

test("an answer waits for a server that is gone", async () => {
  const page = await visit("relation", "gone");
  await begin(page, "relation");
  await watch(page);
  await ANSWERS.relation(page);
  const [, port] = server.address.match(/:(\d+)\//);
  await server.stop("SIGKILL");
  const before = complaints.length;
  await press(page, "Continue");
  await page.getByText("The server cannot be reached").waitFor();
  await nothingInTheWay(page);
  server = await start(...options, "--listen", `127.0.0.1:${port}`);
  await title(page, "Animation 2 of 3");
  await page.waitForFunction(() => document.getElementById("message").textContent === "");
  // A browser complains of connections that are refused.
  const network = complaints.splice(before);
  assert.ok(network.every((text) => text.includes("ERR_CONNECTION")), network.join());
  await page.context().close();
});

test("a study may let raters answer before the end, and its server offers nothing else", async () => {
  const file = await study("relation", { name: "early", answer_before_end: true, demographics: [] });
  const other = await start("--out", join(folder, "early"), "--study", file);
  const page = await (await browser.newContext()).newPage();
  listen(page, complaints);
  await page.goto(`${other.address}study/early/`);
  await press(page, "I agree to take part");
  await press(page, "Begin");
  await title(page, "Animation 1 of 3");
  await ANSWERS.relation(page);
  await press(page, "Continue");
  await title(page, "Animation 2 of 3");
  for (const path of ["", "play/", "playground/", "api/studies", "api/game", "home.js"]) {
    assert.equal((await fetch(`${other.address}${path}`)).status, 404, path);
  }
  const links = await page.$$eval("a", (all) => all.map((link) => link.href));
  assert.deepEqual(links, [], "a rater's page leads nowhere else");
  await page.context().close();
  const admin = await (await browser.newContext()).newPage();
  listen(admin, complaints);
  await admin.goto(`${other.address}admin/#${other.token}`);
  await admin.getByRole("heading", { name: "Studies" }).waitFor();
  assert.ok(await admin.getByRole("heading", { name: "Games" }).isHidden());
  await admin.context().close();
  await other.stop("SIGTERM");
});

test("a rater who withdraws is deleted", async () => {
  const page = await visit("goals", "withdraws");
  await begin(page, "goals");
  await press(page, "Withdraw from the study …");
  await nothingInTheWay(page);
  await press(page, "Go on with the study");
  await title(page, "Animation 1 of 3");
  await press(page, "Withdraw from the study …");
  await press(page, "Withdraw and delete my answers");
  await title(page, "You have withdrawn");
  await page.reload();
  await title(page, "You have withdrawn");
  await page.context().close();
});

test("a visitor who does not agree takes no part", async () => {
  const page = await visit("goals", "declines");
  await title(page, "What");
  await press(page, "I do not agree");
  await title(page, "You do not take part");
  await nothingInTheWay(page);
  await page.context().close();
});

test("a phone shows everything without scrolling sideways", async () => {
  const page = await visit("interactions", "phone", PHONE);
  await begin(page, "interactions");
  const width = () => page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok((await width()) <= 360, `${await width()} px`);
  const small = await page.$$eval("button, select, fieldset label", (all) => all.filter((it) => it.offsetHeight > 0 && it.offsetHeight < 38).length);
  assert.equal(small, 0, "what is touched is large enough");
  await nothingInTheWay(page);
  await screenshot(page, "phone");
  await page.getByRole("button", { name: "Play", exact: true }).tap();
  await page.getByRole("button", { name: "Pause" }).waitFor();
  await page.context().close();
});

test("the person in charge sees how far studies are", async () => {
  const page = await (await browser.newContext()).newPage();
  listen(page, complaints);
  await page.goto(`${server.address}admin/#${server.token}`);
  await page.getByRole("heading", { name: "Studies" }).waitFor();
  await page.getByRole("cell", { name: "1 of 50" }).first().waitFor();
  await nothingInTheWay(page);
  await screenshot(page, "admin");
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Psych-DS of try-goals" }).click()]);
  const tar = await readFile(await download.path(), "utf8");
  assert.ok(tar.includes("dataset_description.json") && !tar.includes("keyboard"));
  assert.ok(tar.includes("<img src=x>") && !tar.includes(",=1+1"));
  await page.context().close();
});

test("the browser has nothing to complain of", () => {
  assert.deepEqual(complaints, []);
});
