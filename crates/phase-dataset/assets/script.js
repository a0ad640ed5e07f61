"use strict";
const FRAMES_PER_SECOND = 20;
const FRAMES_PER_STEP = 5;
const subgoals = JSON.parse(document.getElementById("subgoals").textContent);
const cards = [...document.querySelectorAll(".card")];
const NAMES = {
  "agent 0": "red agent", "agent 1": "green agent", "object 0": "blue object", "object 1": "pink object",
  "landmark 0": "blue landmark", "landmark 1": "green landmark", "landmark 2": "red landmark",
  "landmark 3": "yellow landmark",
};

// Writes a subgoal such as "Attach(agent 0, object 1)" with the colours of the video.
function write(place, text) {
  if (place.dataset.text === text) return;
  place.dataset.text = text;
  const pieces = text.split(/((?:agent|object|landmark) \d)/).map((piece) => {
    if (!(piece in NAMES)) return piece;
    const chip = document.createElement("span");
    chip.className = "chip " + piece.split(" ")[0] + " " + piece.replace(" ", "");
    chip.textContent = NAMES[piece];
    return chip;
  });
  place.replaceChildren(...pieces);
}

// Frame 0 is the start; each step takes the five frames after it.
function show(card) {
  const time = card.querySelector("video").currentTime;
  const frame = Math.floor(time * FRAMES_PER_SECOND + 0.01);
  const step = Math.max(0, Math.floor((frame - 1) / FRAMES_PER_STEP));
  const timeline = subgoals[card.dataset.id] || [];
  timeline.forEach((changes, agent) => {
    const now = changes.filter(([from]) => from <= step).pop();
    const place = card.querySelector(`[data-agent="${agent}"] .subgoal`);
    if (place) write(place, now ? now[1] : "–");
  });
  card.querySelector(".player input").value = time;
  card.querySelector(".player output").textContent = `${time.toFixed(1)} s`;
}

const play = (video) => { const started = video.play(); if (started) started.catch(() => {}); };

// The browser's own controls lie over the picture; ours lie below it.
function control(card) {
  const video = card.querySelector("video");
  const player = card.querySelector(".player");
  const toggle = player.querySelector(".toggle");
  const seek = (time) => {
    video.pause();
    video.currentTime = Math.min(Math.max(time, 0), video.duration || 0);
  };
  const follow = () => {
    show(card);
    const running = !video.paused && !video.ended;
    toggle.textContent = running ? "❚❚" : "▶";
    toggle.setAttribute("aria-label", running ? "pause" : "play");
    if (running) requestAnimationFrame(follow);
  };
  for (const name of ["play", "pause", "seeked", "ended"]) video.addEventListener(name, follow);
  const playOrPause = () => (video.paused || video.ended ? play(video) : video.pause());
  toggle.addEventListener("click", playOrPause);
  video.addEventListener("click", playOrPause);
  const step = FRAMES_PER_STEP / FRAMES_PER_SECOND;
  player.querySelector(".back").addEventListener("click", () => seek(video.currentTime - step));
  player.querySelector(".next").addEventListener("click", () => seek(video.currentTime + step));
  player.querySelector("input").addEventListener("input", (event) => seek(Number(event.target.value)));
  video.controls = false;
  player.hidden = false;
  show(card);
}
cards.forEach(control);

// Videos load their first picture when they come near the window, so that five hundred cost nothing at once.
const playButton = document.getElementById("play");
const inView = new Set();
const playing = () => playButton.getAttribute("aria-pressed") === "true";
const observer = new IntersectionObserver((entries) => {
  for (const { target, isIntersecting } of entries) {
    const video = target.querySelector("video");
    if (isIntersecting) {
      inView.add(video);
      if (video.preload === "none") video.preload = "metadata";
      if (playing()) play(video);
    } else if (inView.delete(video) && playing()) {
      video.pause();
    }
  }
}, { rootMargin: "100px" });
cards.forEach((card) => observer.observe(card));

playButton.addEventListener("click", () => {
  playButton.setAttribute("aria-pressed", String(!playing()));
  for (const video of inView) playing() ? play(video) : video.pause();
});

const filters = [...document.querySelectorAll("[data-filter]")];
function filter(kind) {
  for (const button of filters) button.setAttribute("aria-pressed", String(button.dataset.filter === kind));
  for (const card of cards) {
    card.hidden = kind !== "all" && card.dataset.kind !== kind;
    if (card.hidden) card.querySelector("video").pause();
  }
  const count = cards.filter((card) => !card.hidden).length;
  document.getElementById("shown").textContent = `${count} of ${cards.length} events shown`;
}
filters.forEach((button) => button.addEventListener("click", () => filter(button.dataset.filter)));
filter("all");
