// A rating study: consent, questions about oneself, instructions, videos with a form each, the end. The server decides which page comes next.

import { Refused, connection, memory } from "./connection.js";
import { render } from "./forms.js";

const page = document.getElementById("page");
const message = document.getElementById("message");
const leave = document.getElementById("leave");
const asking = document.getElementById("ask");

// Studies of a server share the browser's storage, so each has a place of its own.
const kept = memory(`phase-study:${location.pathname}`);
const ask = connection("api/", { token: () => kept.get("token"), trouble: (sentence) => say(sentence ?? "") });

function say(sentence) {
  if (message.textContent !== sentence) message.textContent = sentence;
}

function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [attribute, value] of Object.entries(attributes)) made.setAttribute(attribute, value);
  made.append(...children);
  return made;
}

const paragraphs = (texts) => texts.map((text) => element("p", {}, text));

function button(text, action, main = true) {
  const made = element("button", { type: "button", ...(main ? { class: "main" } : {}) }, text);
  made.addEventListener("click", () => {
    made.disabled = true;
    action().finally(() => { made.disabled = false; });
  });
  return made;
}

/** Replaces the page; screen readers begin at its title. */
function put(title, ...children) {
  const heading = element("h1", { tabindex: "-1" }, title);
  page.replaceChildren(heading, ...children);
  document.title = title;
  scrollTo(0, 0);
  heading.focus({ preventScroll: true });
}

/** An order of choices that stays the same for a rater: by a hash of its token and the choice (FNV-1a). */
function order(choices) {
  const hash = (text) => [...text].reduce((sum, letter) => Math.imul(sum ^ letter.codePointAt(0), 16_777_619) >>> 0, 2_166_136_261);
  const key = ({ value }) => hash(`${kept.get("token")}/${value}`);
  return choices.sort((a, b) => key(a) - key(b));
}

/** Sends something and shows the page that follows. What the server refuses because it is at another page leads there. */
async function send(path, body) {
  try {
    show(await ask(path, body));
  } catch (error) {
    if (!(error instanceof Refused)) throw error;
    if (error.status === 401) return begin();
    if (error.status === 409) show(await ask("state"));
    say(error.message);
  }
}

/** Sends an answer; it is kept until the server has it, over a reload too. */
async function answer(body) {
  kept.set({ pending: body });
  await send("answer", body);
  kept.set({ pending: null });
}

function player(address, played) {
  const video = element("video", { src: address, playsinline: "", preload: "auto", "aria-label": "The animation, without sound" });
  video.muted = true;
  video.disablePictureInPicture = true;
  const time = element("progress", { max: "1", value: "0", "aria-label": "How much of the animation has been shown" });
  const control = element("button", { type: "button", class: "play" }, "Play");
  const status = element("p", { class: "phase-problem", role: "status" });
  video.addEventListener("timeupdate", () => { time.value = video.duration ? video.currentTime / video.duration : 0; });
  video.addEventListener("play", () => { control.textContent = "Pause"; });
  video.addEventListener("pause", () => { control.textContent = video.ended ? "Play again" : "Play on"; });
  video.addEventListener("ended", () => {
    time.value = 1;
    control.textContent = "Play again";
    played();
  });
  video.addEventListener("error", () => {
    control.textContent = "Load again";
    status.textContent = "The animation cannot be loaded.";
  });
  control.addEventListener("click", () => {
    if (video.error) {
      status.textContent = "";
      control.textContent = "Play";
      video.load();
    } else if (video.paused) {
      video.play().catch(() => { /* the event `error` says why */ });
    } else {
      video.pause();
    }
  });
  return element("div", { class: "player" }, video, time, control, status);
}

function trial({ trial: number, trials, video, questions, answer_before_end: beforeEnd }) {
  let plays = 0;
  const begun = performance.now();
  const form = element("div");
  const wait = element("p", { role: "status" }, beforeEnd ? "" : "You can answer when the animation has ended.");
  const enable = (yes) => [...made.elements].forEach((control) => { control.disabled = !yes; });
  const played = () => {
    plays += 1;
    if (plays > 1 || beforeEnd) return;
    wait.textContent = "";
    enable(true);
  };
  put(`Animation ${number} of ${trials}`, player(video, played), wait, form);
  const made = render(form, questions, {
    shuffle: order,
    ready: () => (beforeEnd || plays > 0 ? null : "Please watch the animation to its end first."),
    submitted: async (given) => {
      enable(false);
      await answer({ trial: number, answer: given, response_time: Math.round(performance.now() - begun), plays });
      enable(true);
    },
  });
  enable(beforeEnd);
}

function done({ code, url }) {
  const parts = [element("p", {}, "You have answered everything. Thank you!")];
  if (code) parts.push(element("p", {}, "Your completion code: ", element("code", { class: "code" }, code)));
  if (url?.startsWith("https://")) parts.push(element("p", {}, element("a", { class: "button main", href: url, rel: "noreferrer" }, "Finish")));
  put("Done", ...parts);
}

const PAGES = {
  consent: ({ title, introduction, consent }) => put(title, ...paragraphs([...introduction, ...consent]), element("p", { class: "bar" },
    button("I agree to take part", () => send("consent", { agrees: true })),
    button("I do not agree", () => send("consent", { agrees: false }), false))),
  demographics({ questions }) {
    put("About you");
    render(page, questions, { submitted: (given) => send("demographics", given) });
  },
  instructions: ({ instructions }) => put("Instructions", ...paragraphs(instructions), button("Begin", () => send("instructions", {}))),
  trial,
  done,
  declined: () =>
    put("You do not take part", element("p", {}, "No answers were stored. You can close this page.")),
  withdrawn: () => put("You have withdrawn", element("p", {}, "Your answers were deleted. You can close this page.")),
  full: () => put("No place is free", element("p", {}, "All places of this study are taken at this time. Some may become free later. Thank you for your interest!")),
};

function show(stage) {
  say("");
  leave.hidden = !["demographics", "instructions", "trial", "done"].includes(stage.page);
  PAGES[stage.page](stage);
}

async function join() {
  const parameters = Object.fromEntries(new URLSearchParams(location.search));
  try {
    const joined = await ask("join", { parameters });
    kept.set({ token: joined.token, search: location.search, pending: null });
    show(joined.stage);
  } catch (error) {
    put("This study cannot begin");
    say(error.message);
  }
}

/** Goes on where one was in this browser, unless one comes as somebody else. */
async function begin() {
  if (!kept.get("token") || (location.search && location.search !== kept.get("search"))) return join();
  const pending = kept.get("pending");
  try {
    if (pending) await ask("answer", pending).catch((error) => { if (!(error instanceof Refused) || error.status === 401) throw error; });
    kept.set({ pending: null });
    show(await ask("state"));
  } catch (error) {
    // The token is what one's answers hang on: it is given up only where the server does not know it.
    if (error instanceof Refused && error.status === 401) return join();
    put("This study cannot go on");
    say(error.message);
  }
}

document.getElementById("withdraw").addEventListener("click", () => asking.showModal());
document.getElementById("ask-no").addEventListener("click", () => asking.close());
document.getElementById("ask-yes").addEventListener("click", async () => {
  asking.close();
  await send("withdraw", {});
});

begin();
