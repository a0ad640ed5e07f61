// The two-player game: the server has the world, this page has keys and a picture of what the server says is seen.
import { Arena, cells } from "./arena.js";
import { Keys } from "./keys.js";

const at = (id) => document.getElementById(id);
const FRAME_MS = 50;
const RETRIES_MS = [300, 1000, 2000, 4000, 8000];
const ENDINGS = {
  complete: "All rounds are played. Thank you!",
  left: "A player has left, so the game is over.",
  absent: "A player was away for too long, so the game is over.",
  failed: "The server could not go on with this game. What was finished is kept.",
};

// There is little room on a phone, which has no such keys either.
at("keys").open = !matchMedia("(max-width: 760px)").matches;
const arena = new Arena(at("arena"));
let socket = null;
let welcome = null;
let stage = null;
let state = null;
let frames = []; // frames that are still to be shown
let shown = null;
let grips = [null, null];
let seen = null;
let retries = 0;
let result = null;
let timer = 0;

const token = () => location.hash.slice(1);
const say = (text, wrong = false) => {
  at("message").textContent = text;
  at("message").classList.toggle("wrong", wrong);
};
const send = (message) => socket?.readyState === WebSocket.OPEN && socket.send(JSON.stringify(message));
const paragraph = (text, name = "") => Object.assign(document.createElement("p"), { textContent: text, className: name });

// Keys count from the countdown on, so that a key pressed early is not lost.
const keys = new Keys({
  hold: (action) => send({ type: "hold", action }),
  grab: () => send({ type: "grab" }),
  active: () => state?.doing === "playing" || state?.doing === "countdown",
  pad: at("pad"),
});

// --- before there is a room

function lobby() {
  at("lobby").hidden = false;
  say("");
}

at("lobby").addEventListener("submit", async (event) => {
  event.preventDefault();
  const { partner, view } = Object.fromEntries(new FormData(event.target));
  const answer = await fetch("../api/rooms", { method: "POST", body: JSON.stringify({ partner, view }) }).catch(() => null);
  const room = await answer?.json().catch(() => null);
  if (!answer?.ok) return say(room?.error ?? "The server cannot be reached.", true);
  const guest = room.tokens[1 - room.agent];
  if (guest) sessionStorage.setItem(`phase-guest-${room.tokens[room.agent]}`, guest);
  location.hash = room.tokens[room.agent];
});

at("copy").addEventListener("click", async () => {
  at("link").select();
  await navigator.clipboard?.writeText(at("link").value).catch(() => {});
  say("The link is copied.");
});

// --- the connection

function connect() {
  at("lobby").hidden = true;
  const address = new URL("socket", location.href);
  address.protocol = address.protocol === "https:" ? "wss:" : "ws:";
  address.hash = "";
  socket = new WebSocket(address);
  const mine = socket;
  socket.addEventListener("open", () => send({ type: "join", token: token() }));
  socket.addEventListener("message", ({ data }) => mine === socket && receive(JSON.parse(data)));
  socket.addEventListener("close", ({ code, reason }) => {
    if (mine !== socket || state?.doing === "over") return;
    state = null;
    if (code === 1008) return say(`${reason[0]?.toUpperCase() ?? ""}${reason.slice(1)}.`, true);
    if (code === 4001) return say("This game goes on in another tab; reload this page to play here.", true);
    say("The connection is lost; trying again …", true);
    overlay("…", false);
    timer = setTimeout(connect, RETRIES_MS[Math.min(retries, RETRIES_MS.length - 1)]);
    retries += 1;
  });
}

function receive(message) {
  retries = 0;
  switch (message.type) {
    case "welcome":
      welcome = message;
      if (document.hidden) send({ type: "away", away: true });
      break;
    case "stage":
      stage = message;
      frames = [];
      keys.release();
      break;
    case "sight":
      sight(message);
      break;
    case "result":
      result = message.achieved;
      break;
    case "state":
      state = message;
      break;
    case "problem":
      console.warn(message.text);
      return;
  }
  if (message.type === "state" || message.type === "stage") describe();
}

document.addEventListener("visibilitychange", () => send({ type: "away", away: document.hidden }));

// --- the picture

function sight(message) {
  if (message.frames.length === 1) shown = null;
  // A page that has fallen behind shows the newest step only.
  if (frames.length > 5) frames = [];
  frames.push(...message.frames.map((bodies) => ({ bodies, grips: message.grips, seen: message.visible })));
  at("clock").max = stage.steps;
  at("clock").value = message.step;
  if (!shown) show();
}

function show() {
  const next = frames.shift();
  if (next) {
    shown = next.bodies;
    grips = next.grips;
    seen = next.seen ? cells(next.seen) : null;
  }
  if (stage && shown) arena.draw(stage, shown, grips, seen);
}
setInterval(show, FRAME_MS);

let counting = 0;
function overlay(text, words) {
  clearInterval(counting);
  at("overlay").textContent = text;
  at("overlay").classList.toggle("words", words);
}

function countDown(ms) {
  const end = performance.now() + ms;
  const tick = () => overlayNumber(Math.ceil((end - performance.now()) / 1000));
  const overlayNumber = (seconds) => { at("overlay").textContent = seconds > 0 ? String(seconds) : ""; };
  overlay("", false);
  tick();
  counting = setInterval(tick, 100);
}

// --- the words

function describe() {
  if (!state || !stage || !welcome) return;
  const me = welcome.agent;
  const { doing, ready, present } = state;
  at("game").hidden = doing === "gathering";
  at("game").classList.toggle("playing", doing === "playing" || doing === "countdown");
  const guest = sessionStorage.getItem(`phase-guest-${token()}`);
  at("invitation").hidden = !(doing === "gathering" && guest);
  if (guest) at("link").value = new URL(`#${guest}`, location.href).href;
  const practice = stage.round === 0;
  at("round").textContent = practice ? "Practice" : `Round ${stage.round} of ${stage.rounds}`;
  tell(practice);
  const asked = (doing === "reading" || (doing === "playing" && practice)) && !ready[me];
  at("ready").hidden = !asked;
  at("ready").textContent = doing === "playing" ? "I have practised enough" : practice ? "Begin the practice" : "I am ready";
  at("leave").hidden = doing === "over";
  const outcome = outcomeOf(me);
  const waiting = welcome.mind ? "" : " Waiting for the other player …";
  const lines = {
    gathering: guest ? "Waiting for the other player …" : "Waiting for the other player …",
    reading: ready[me] ? `You are ready.${waiting}` : practice ? "Read this, then begin the practice." : `${outcome} Read your goal, then press the button when you are ready.`.trim(),
    countdown: "It begins.",
    playing: practice && ready[me] ? `You have practised enough.${waiting}` : practice ? "Practice: try all keys." : "Play!",
    paused: present[1 - me] ? "The game is paused." : "The other player is away. The game goes on when they are back.",
    over: ENDINGS[state.ending] ?? "The game is over.",
  };
  say(lines[doing]);
  if (doing === "countdown") countDown(state.countdown_ms);
  else overlay(doing === "paused" ? "Paused" : doing === "over" ? "The game is over" : "", true);
  if (doing === "countdown" || doing === "playing") at("arena").focus({ preventScroll: true });
  if (doing === "over") at("told").replaceChildren(...[outcome, lines.over].filter(Boolean).map((text) => paragraph(text)));
}

/** How the last round ended for a player, in a sentence; empty before there was one. */
function outcomeOf(me) {
  if (result) return `The round is over: your goal was ${result[me] ? "reached" : "not reached"}.`;
  return stage.round > 0 ? "The practice is over." : "";
}

function tell(practice) {
  const told = [];
  if (practice) {
    told.push(paragraph(`You move the ${welcome.you}.`, "you"));
    if (welcome.view === "own") told.push(paragraph("You see only what your agent sees: what lies ahead of its eyes and is not hidden by walls or bodies, and what it touches. Everything else is covered in grey, and others are drawn only while they are seen."));
    told.push(paragraph("Try to move, to turn, and to grab an object and carry it. There is no goal yet."));
  } else {
    const { you, yours, theirs } = stage.instructions;
    told.push(paragraph(`You are the ${you} agent.`, "you"), paragraph(yours, "you"), paragraph(theirs));
  }
  at("told").replaceChildren(...told);
}

at("ready").addEventListener("click", () => send({ type: "ready" }));
at("leave").addEventListener("click", () => send({ type: "leave" }));

addEventListener("hashchange", () => location.reload());
if (/^[0-9a-f]{32}$/.test(token())) connect();
else lobby();
addEventListener("pagehide", () => clearTimeout(timer));
