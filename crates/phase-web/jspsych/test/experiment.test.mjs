// A whole experiment in a browser, answered with the keyboard.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { fileURLToPath } from "node:url";
import { after, before, test } from "node:test";
import { questions, passed, problem, INTERACTIONS } from "@phase-events/forms";
import { launch, serve } from "../../tests/browser/site.mjs";

const AXE = createRequire(import.meta.url).resolve("axe-core/axe.min.js");
// A video of PHASE, if there is one; without it the plugin has to say that it cannot be played.
const VIDEO = process.env.PHASE_VIDEO;
let site, browser;

before(async () => {
  site = await serve(fileURLToPath(new URL("..", import.meta.url)), VIDEO ? { "/test/event.mp4": VIDEO } : {});
  browser = await launch();
});

after(async () => {
  await browser?.close();
  site?.close();
});

async function barriers(page) {
  await page.evaluate(await readFile(AXE, "utf8"));
  const { violations } = await page.evaluate(() => window.axe.run(".jspsych-content"));
  return violations.map(({ id, nodes }) => [id, nodes.map((node) => node.html)]);
}

test("forms ask what they say", () => {
  assert.equal(INTERACTIONS.length, 23);
  assert.deepEqual([INTERACTIONS[0].text, INTERACTIONS[10].text, INTERACTIONS[22].text], ["not interacting", "following the lead (of another agent)", "collaborating"]);
  assert.equal(new Set(INTERACTIONS.map(({ value }) => value)).size, 23);
  assert.deepEqual(questions("goals").map(({ name }) => name), ["goal_0", "goal_1", "relation", "human_likeness"]);
  assert.ok(questions("goals", { objects: 2 })[0].choices.length > questions("goals", { objects: 0 })[0].choices.length);
  for (const form of ["mood", "toString"]) assert.throws(() => questions(form), new RegExp(`not ${form}`));
  assert.equal(problem("relation", { relation: "neutral" }), null);
  for (const rubbish of [null, {}, { relation: "" }, { relation: "angry" }, { relation: ["neutral", "friendly"] }]) {
    assert.notEqual(problem("relation", rubbish), null);
  }
  assert.notEqual(problem("interactions", { interactions: [] }), null);
});

test("catch trials are passed as in the study server", async () => {
  const cases = JSON.parse(await readFile(new URL("catch_trials.json", import.meta.url), "utf8"));
  for (const { form, expected, answer, passed: right } of cases) {
    assert.equal(problem(form, answer), null, "an answer that the form takes");
    assert.equal(passed(expected, answer), right, JSON.stringify({ expected, answer }));
  }
  assert.equal(passed({ relation: "neutral" }, {}), false);
});

test("a video that is paused can be played on", async () => {
  const page = await browser.newPage();
  await page.goto(`${site.address}test/experiment.html`);
  const buttons = await page.evaluate(() => {
    const place = document.body.appendChild(document.createElement("div"));
    new jsPsychPhaseVideo({ finishTrial() {} }).trial(place, { video: "none.mp4", prompt: "", description: "", replays: 0, width: 100, autoplay: true, button_label: "Go on" });
    const video = place.querySelector("video");
    video.onerror = null;
    const state = () => [...place.querySelectorAll("button")].map((button) => [button.textContent, button.disabled]);
    const seen = [state()];
    for (const event of ["play", "pause", "play"]) {
      video.dispatchEvent(new Event(event));
      seen.push(state());
    }
    return seen;
  });
  assert.deepEqual(buttons.map(([[text, disabled]]) => [text, disabled]), [["Play", true], ["Play", true], ["Play on", false], ["Play on", true]]);
  assert.ok(buttons.every(([, [, disabled]]) => disabled), "one goes on once it has been watched");
  await page.close();
});

test("a person answers everything with the keyboard", async () => {
  const page = await browser.newPage();
  await page.goto(`${site.address}test/experiment.html${VIDEO ? "?video=/test/event.mp4" : ""}`);
  const next = page.getByRole("button", { name: "Continue" });
  assert.equal(await page.locator(".jspsych-content b").count(), 0, "prompts are text");
  await page.waitForFunction(() => [...document.querySelectorAll("button")].some((it) => it.textContent === "Continue" && !it.disabled), null, { timeout: 60_000 });
  assert.deepEqual(await barriers(page), []);
  await next.press("Enter");

  await next.press("Enter");
  await page.getByRole("alert").getByText("Please answer").waitFor();
  assert.deepEqual(await barriers(page), []);
  for (const label of ["helping", "playing tug of war"]) await page.getByLabel(label, { exact: true }).press("Space");
  await next.press("Enter");

  await page.getByLabel("goal of the red agent").selectOption("light blue on green");
  await page.getByLabel("goal of the green agent").selectOption("help");
  await page.getByLabel("friendly").press("Space");
  assert.deepEqual(await barriers(page), []);
  await page.getByLabel("5, very likely").press("Space");
  await next.press("Enter");

  await page.getByLabel("friendly").press("Space");
  await next.press("Enter");
  await page.waitForFunction(() => window.finished);
  const [video, interactions, goals, relation] = await page.evaluate(() => window.finished);
  assert.equal(video.failed, !VIDEO);
  assert.equal(video.watched, VIDEO ? 1 : 0);
  assert.deepEqual(interactions.response, { interactions: ["helping", "playing tug of war"] });
  assert.deepEqual(goals.response, { goal_0: "light blue on green", goal_1: "help", relation: "friendly", human_likeness: "5" });
  assert.deepEqual([relation.response, relation.correct, relation.event], [{ relation: "friendly" }, false, "demo-0000"]);
  assert.ok(relation.rt > 0);
  await page.close();
});

test("it can be simulated", async () => {
  const page = await browser.newPage();
  await page.goto(`${site.address}test/experiment.html?simulate`);
  await page.waitForFunction(() => window.finished);
  const data = await page.evaluate(() => window.finished);
  assert.equal(data.length, 4);
  for (const { form, response } of data.slice(1)) assert.equal(problem(form, response, { objects: form === "goals" ? 1 : 2 }), null);
  await page.close();
});

test("plugins have what jsPsych asks for", async () => {
  const page = await browser.newPage();
  await page.goto(`${site.address}test/experiment.html?simulate`);
  const infos = await page.evaluate(() => [jsPsychPhaseVideo.info, jsPsychPhaseRating.info].map(({ name, version, data, parameters, citations }) =>
    ({ name, version, data: Object.keys(data), parameters: Object.keys(parameters), citations: Object.keys(citations) })));
  for (const { version, data, parameters, citations } of infos) {
    assert.match(version, /^\d+\.\d+\.\d+$/);
    assert.ok(data.includes("rt") && parameters.includes("button_label"));
    assert.deepEqual(citations, ["apa", "bibtex"]);
  }
  await page.close();
});
