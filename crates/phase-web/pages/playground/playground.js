// The playground: plays, edits and shows one event. A worker simulates it, another one infers; this page draws.
import init, { Events, Picture, Simulation, sampleScene, startState, stateLength, actions } from "./phase.js";
import { Editor } from "./editor.js";
import { Keyboard } from "./keyboard.js";
import { showPosterior, showThoughts } from "./panels.js";
import * as share from "./share.js";
import { Film } from "./video.js";

const SUBSTEPS = 5; // of a step
const FRAMES_PER_SECOND = 20; // substeps that are shown in a second
const AHEAD = 3; // steps that are simulated before they are shown
const BODY = 6; // numbers of a body in a packed state
const BODIES = 4;

const byId = (id) => document.getElementById(id);
const settings = () => ({
  seed: Number(byId("event-seed").value),
  options: { engine: byId("engine").value, minds: { simulations: Number(byId("simulations").value) } },
});

await init();
const STATE = stateLength();
const ACTIONS = actions();
const canvas = byId("picture");
const context = canvas.getContext("2d");
const keyboard = new Keyboard(canvas);

let picture = null;
let run = 0; // number of the simulation; answers of older ones are ignored
let steps = []; // what the simulator answered: the initial state, then one for each step
let answers = []; // of the observer, by step
let pending = false; // whether a step is being simulated
let running = false;
let simulated = true; // false for an event from a file, which is only shown
let editable = true; // an event without labels has no scene to edit
let film = null; // the video that is shown in place of drawings
let playhead = 0; // substeps
let shownMind = null;
let shownStep = null;
let took = [];

function say(text, wrong = false) {
  const message = byId("message");
  message.textContent = text;
  message.classList.toggle("wrong", wrong);
}

const simulator = new Worker(new URL("simulator.js", import.meta.url), { type: "module" });
const observer = new Worker(new URL("observer.js", import.meta.url), { type: "module" });
for (const worker of [simulator, observer]) worker.onerror = () => say("A part of the playground could not be loaded.", true);

simulator.onmessage = ({ data }) => {
  if (data.run !== run) return;
  pending = false;
  if (data.error) {
    running = false;
    say(data.error, true);
    return;
  }
  if (data.document) {
    save(data.document, "event.json");
    return;
  }
  steps.push(data);
  if (data.report.step > 0) {
    took.push(data.took);
    observer.postMessage({ run, row: data.row, step: data.report.step });
  }
  byId("time").max = String((steps.length - 1) * SUBSTEPS);
  if (running) ask();
};

observer.onmessage = ({ data }) => {
  if (data.run !== run) return;
  if (data.error) return say(data.error, true);
  answers[data.step] = data.answer;
  shownStep = null;
};

/** Forgets what was shown, and gets ready to show a scene. */
function reset(scene) {
  run += 1;
  [steps, answers, took] = [[], [], []];
  [pending, running, simulated, editable, playhead, shownMind, shownStep] = [true, false, true, true, 0, null, null];
  film?.close();
  film = null;
  byId("time").max = "0";
  picture?.free();
  picture = new Picture(scene, canvas.width, byId("palette").value);
  byId("events-of-file").hidden = true;
  for (const id of ["run", "step", "restart", "time"]) byId(id).disabled = false;
}

/** Begins the scene of the editor anew. */
function restart() {
  const scene = JSON.stringify(editor.scene);
  reset(scene);
  simulator.postMessage({ run, start: { scene, ...settings() } });
  observer.postMessage({ run, start: { scene, row: startState(scene) } });
}

const last = () => steps[steps.length - 1];
const isOver = () => Boolean(last()?.report.over);

/** Asks for the next step if it is time for it. */
function ask() {
  if (pending || !simulated || steps.length === 0) return;
  const ready = (steps.length - 1) * SUBSTEPS - playhead;
  const keys = editor.control.indexOf("keys");
  // Keys are read as late as possible; minds are asked ahead.
  if (ready > (keys < 0 ? AHEAD * SUBSTEPS : 2)) return;
  if (isOver() && keys < 0) return;
  const given = [-1, -1];
  if (keys >= 0) given[keys] = ACTIONS.indexOf(keyboard.action(holds(last(), keys)));
  pending = true;
  simulator.postMessage({ run, step: given });
}

function holds(step, agent) {
  return step.frames[step.frames.length - STATE + BODIES * BODY + 3 * agent] >= 0;
}

/** The state at a time in substeps, between two of them a mean of both. */
function stateAt(time) {
  const at = (substep) => {
    const step = Math.ceil(substep / SUBSTEPS);
    const frames = steps[Math.min(step, steps.length - 1)].frames;
    const index = step === 0 ? 0 : substep - (step - 1) * SUBSTEPS - 1;
    return frames.subarray(index * STATE, (index + 1) * STATE);
  };
  const before = at(Math.floor(time));
  const share = time - Math.floor(time);
  if (share === 0) return before;
  const after = at(Math.floor(time) + 1);
  const mean = Float32Array.from(before);
  for (let k = 0; k < BODIES * BODY; k += 1) {
    const change = after[k] - before[k];
    // An angle that jumps by more than half a turn has only changed its name.
    mean[k] += Math.abs(change) > Math.PI ? 0 : share * change;
  }
  return mean;
}

function draw() {
  if (steps.length === 0) return;
  const step = steps[Math.min(Math.floor(playhead / SUBSTEPS), steps.length - 1)];
  const agent = Number(document.querySelector("input[name=mind]:checked").value);
  const mind = agent < 0 || !step.views ? null : step;
  if (shownMind?.mind !== mind || shownMind?.agent !== agent) {
    if (mind) picture.showMind(agent, mind.views[agent], mind.beliefs[agent]);
    else picture.hideMind();
    shownMind = { mind, agent };
  }
  if (film) {
    film.show(running, playhead / FRAMES_PER_SECOND);
    film.draw(context, Math.min(playhead, (steps.length - 1) * SUBSTEPS) / FRAMES_PER_SECOND);
  } else {
    drawScene();
  }
  byId("time").value = String(Math.round(playhead));
  byId("clock").textContent = `${(playhead / FRAMES_PER_SECOND).toFixed(1)} s`;
  const number = Math.floor(playhead / SUBSTEPS);
  if (shownStep !== number) {
    shownStep = number;
    showThoughts(byId("thoughts"), step.report);
    const known = answers.slice(0, number + 1).findLastIndex((answer) => answer);
    showPosterior(byId("posterior"), known < 0 ? null : answers[known], known);
  }
}

function drawScene() {
  const pixels = picture.draw(stateAt(Math.min(playhead, (steps.length - 1) * SUBSTEPS)));
  context.putImageData(new ImageData(new Uint8ClampedArray(pixels.buffer, pixels.byteOffset, pixels.length), picture.width), 0, 0);
}

let then = performance.now();
let waited = 0;
function tick(now) {
  const passed = Math.min(now - then, 100);
  then = now;
  if (running && steps.length > 0) {
    const end = (steps.length - 1) * SUBSTEPS;
    const wanted = film ? film.time * FRAMES_PER_SECOND : playhead + (passed * FRAMES_PER_SECOND) / 1000;
    waited = wanted > end ? waited + passed : Math.max(0, waited - passed / 4);
    playhead = Math.min(wanted, end);
    ask();
    const over = isOver() && !editor.control.includes("keys");
    if (playhead >= end && (!simulated || over)) {
      running = false;
      say(over && simulated ? "The event is over: nobody has anything more to do. Step goes on." : "This is the end of the event.");
    }
    rate();
  }
  byId("run").textContent = running ? "Pause" : "Run";
  draw();
  requestAnimationFrame(tick);
}

function rate() {
  if (took.length === 0) return;
  const recent = took.slice(-20);
  const mean = recent.reduce((sum, it) => sum + it, 0) / recent.length;
  const slow = waited > 500 ? ": slower than real time here; fewer simulations are faster" : "";
  byId("rate").textContent = `Two minds and their world take ${mean.toFixed(0)} ms of each 250 ms step${slow}.`;
}

function save(text, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type: "application/json" }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** Shows an event of a file, or a film of one. Restart simulates the scene of the editor, which is the event's if it has labels. */
function replay(events, index, file, shown = null) {
  const labelled = events.labelled(index);
  const scene = events.scene(index);
  if (labelled) editor.take(JSON.parse(scene));
  reset(scene);
  [simulated, pending, editable, film] = [false, false, labelled, shown];
  const [frames, rows] = [events.frames(index), events.rows(index)];
  const count = rows.length / STATE;
  const piece = (from, to) => frames.slice(from * STATE, to * STATE);
  for (let k = 0; k < count; k += 1) {
    const from = k === 0 ? 0 : (k - 1) * SUBSTEPS + 1;
    steps.push({ frames: piece(from, k === 0 ? 1 : from + SUBSTEPS), report: { step: k, over: k + 1 === count } });
  }
  byId("time").max = String((steps.length - 1) * SUBSTEPS);
  const start = labelled ? { scene: JSON.stringify(editor.scene), row: rows.slice(0, STATE) } : { file, index };
  observer.postMessage({ run, start });
  for (let k = 1; k < count; k += 1) observer.postMessage({ run, row: rows.slice(k * STATE, (k + 1) * STATE), step: k });
  const notes = shown ? shown.notes.map((note) => ` ${note}.`).join("") : "";
  if (labelled) say(`${events.id(index)}: an event from a file. Restart lets minds play its scene.`);
  else say(`${events.id(index)}: ${shown ? "a video, with what was found in it." : "an event without labels."}${notes} Restart goes back to the scene below.`);
}

async function open(file) {
  if (file.type.startsWith("video/") || /\.(mp4|m4v|mov|webm)$/i.test(file.name)) return openVideo(file);
  let events, text;
  try {
    text = await file.text();
    events = new Events(text);
  } catch (error) {
    return say(`${file.name}: ${error.message}`, true);
  }
  const list = byId("events");
  list.replaceChildren(...Array.from({ length: events.length }, (_, k) => new Option(events.id(k), k)));
  const show = () => {
    const index = Number(list.value);
    if (events.rows(index).length > STATE) {
      replay(events, index, text);
    } else {
      editor.take(JSON.parse(events.scene(index)));
      restart();
      say(`${events.id(index)}: a scene from a file.`);
    }
    byId("events-of-file").hidden = events.length < 2;
  };
  list.onchange = show;
  show();
}

async function openVideo(file) {
  running = false;
  const begun = (run += 1); // what comes meanwhile is not wanted
  try {
    const read = await Film.read(file, (pass, share) => {
      if (run !== begun) throw new Error("another event was opened");
      const what = ["agents", "the ground", "shapes"][pass];
      say(`${file.name}: looking for ${what}, ${Math.round(100 * share)} %`);
    });
    replay(new Events(read.document), 0, read.document, read);
  } catch (error) {
    if (run === begun) restart();
    say(`${file.name}: ${error.message}`, true);
  }
}

const editor = new Editor(() => { restart(); say("The scene has changed."); }, (text) => say(text, true));

function sample() {
  try {
    const seed = BigInt(Math.max(0, Math.round(Number(byId("seed").value))));
    editor.take(JSON.parse(sampleScene(byId("kind").value, byId("variant").value || undefined, seed)));
  } catch (error) {
    return say(error.message, true);
  }
  restart();
  say(`A ${editor.scene.event} scene. Run it, or drag bodies while time is 0.`);
}

byId("run").onclick = () => {
  running = !running;
  const end = (steps.length - 1) * SUBSTEPS;
  if (running && playhead >= end && (isOver() || !simulated) && !editor.control.includes("keys")) playhead = 0;
  if (running) {
    say("");
    if (editor.control.includes("keys")) canvas.focus();
    ask();
  }
};
byId("step").onclick = () => {
  running = false;
  const next = (Math.floor(playhead / SUBSTEPS) + 1) * SUBSTEPS;
  if (next <= (steps.length - 1) * SUBSTEPS) {
    playhead = next;
  } else if (simulated && !pending) {
    const keys = editor.control.indexOf("keys");
    const given = [-1, -1];
    if (keys >= 0) given[keys] = ACTIONS.indexOf(keyboard.action(holds(last(), keys)));
    pending = true;
    simulator.postMessage({ run, step: given });
    const begun = run;
    const follow = () => (pending && begun === run ? setTimeout(follow, 10) : (playhead = Math.min(next, (steps.length - 1) * SUBSTEPS)));
    follow();
  }
};
byId("restart").onclick = () => { restart(); say(""); };
byId("time").oninput = () => { running = false; playhead = Number(byId("time").value); shownStep = null; };
byId("sample").onclick = sample;
byId("save-scene").onclick = () => {
  const { seed, options } = settings();
  const simulation = new Simulation(JSON.stringify(editor.scene), BigInt(seed), JSON.stringify(options));
  save(simulation.document("scene"), "scene.json");
  simulation.free();
};
byId("save-event").onclick = () => {
  if (!simulated) return say("This event comes from a file already.");
  simulator.postMessage({ document: "event" });
};
byId("open").onchange = () => { if (byId("open").files[0]) open(byId("open").files[0]); byId("open").value = ""; };
document.addEventListener("dragover", (event) => event.preventDefault());
document.addEventListener("drop", (event) => {
  event.preventDefault();
  if (event.dataTransfer.files[0]) open(event.dataTransfer.files[0]);
});
byId("share").onclick = async () => {
  history.replaceState(null, "", await share.fragment({ scene: editor.scene, ...settings() }));
  try {
    await navigator.clipboard.writeText(location.href);
    say("The link to this scene is copied.");
  } catch {
    say("The address of this page is now the link to this scene.");
  }
};
for (const id of ["simulations", "engine", "event-seed", "palette"]) {
  byId(id).onchange = () => {
    if (!byId(id).checkValidity()) return say(`${id}: ${byId(id).validationMessage}`, true);
    restart();
    say("");
  };
}

// Bodies are dragged while time is 0.
let dragged = null;
const world = ({ clientX, clientY }) => {
  const box = canvas.getBoundingClientRect();
  const [left, top] = picture.pixel(6, 22);
  const [right, bottom] = picture.pixel(26, 2);
  const x = ((clientX - box.left) / box.width) * canvas.width;
  const y = ((clientY - box.top) / box.height) * canvas.height;
  return [6 + (20 * (x - left)) / (right - left), 22 - (20 * (y - top)) / (bottom - top)];
};
canvas.onpointerdown = (event) => {
  if (running || !picture || !editable) return;
  const [x, y] = world(event);
  const bodies = editor.description.radii.map((radius, k) => ({ k: k < 2 ? k : k, radius, start: editor.start(k) }));
  const hit = bodies.find(({ radius, start }) => Math.hypot(start.x - x, start.y - y) <= radius * 1.2);
  if (!hit) return;
  if (playhead > 0) return say("Bodies are moved while time is 0: press Restart.");
  dragged = { body: hit.k, x: hit.start.x - x, y: hit.start.y - y };
  canvas.setPointerCapture(event.pointerId);
};
canvas.onpointermove = (event) => {
  if (!dragged) return;
  const [x, y] = world(event);
  editor.move(dragged.body, { x: x + dragged.x, y: y + dragged.y });
};
canvas.onpointerup = canvas.onpointercancel = () => { dragged = null; };
canvas.addEventListener("wheel", (event) => {
  if (running || playhead > 0 || !picture || !editable) return;
  const [x, y] = world(event);
  const agent = [0, 1].find((k) => Math.hypot(editor.start(k).x - x, editor.start(k).y - y) <= editor.description.radii[k] * 1.2);
  if (agent === undefined) return;
  event.preventDefault();
  editor.move(agent, { angle: editor.start(agent).angle - Math.sign(event.deltaY) * (Math.PI / 24) });
}, { passive: false });

const given = await share.value(location.hash);
try {
  if (!given) throw null;
  editor.take(given.scene);
  if (Number.isSafeInteger(given.seed)) byId("event-seed").value = given.seed;
  if (given.options?.minds?.simulations) byId("simulations").value = given.options.minds.simulations;
  if (["world", "forward"].includes(given.options?.engine)) byId("engine").value = given.options.engine;
  restart();
  say("A scene from a link.");
} catch (error) {
  sample();
  if (location.hash.length > 1) say(`The link holds no scene${error ? `: ${error.message}` : ""}; here is another one.`, true);
}
requestAnimationFrame(tick);
