"use strict";
const FRAMES_PER_SECOND = 20;
const FRAMES_PER_STEP = 5;
const { texts, names, events } = JSON.parse(document.getElementById("timelines").textContent);
const cards = [...document.querySelectorAll(".card")];

// Writes a subgoal such as "Attach(agent 0, object 1)" with the colours of the video.
function write(place, text) {
  if (place.dataset.text === text) return;
  place.dataset.text = text;
  const pieces = text.split(/((?:agent|object|landmark) \d)/).map((piece) => {
    if (!(piece in names)) return piece;
    const chip = document.createElement("span");
    chip.className = "chip " + piece.split(" ")[0] + " " + piece.replace(" ", "");
    chip.textContent = names[piece];
    return chip;
  });
  place.replaceChildren(...pieces);
}

// A track of the table as one entry a step: the subgoal's place in the texts and the share of particles.
function unroll([changes, shares]) {
  let text = 0;
  return [...shares].map((digit, step) => {
    for (let k = 0; k < changes.length; k += 2) if (changes[k] === step) text = changes[k + 1];
    return { text, share: parseInt(digit, 36) / 35 };
  });
}

// Frame 0 is the start; each step takes the five frames after it.
const frameOf = (video) => Math.floor(video.currentTime * FRAMES_PER_SECOND + 0.01);
const stepOf = (frame) => Math.max(0, Math.floor((frame - 1) / FRAMES_PER_STEP));

// Bars for both agents; subgoals that are the same have the same colour.
function draw(card, tracks, frame) {
  const canvas = card.querySelector(".timeline");
  const scale = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (!width) return;
  if (canvas.width !== Math.round(width * scale)) [canvas.width, canvas.height] = [width * scale, height * scale];
  const pen = canvas.getContext("2d");
  pen.setTransform(scale, 0, 0, scale, 0, 0);
  pen.clearRect(0, 0, width, height);
  const steps = Number(card.dataset.steps);
  const row = height / tracks.length;
  tracks.forEach((track, agent) => {
    const bottom = (agent + 1) * row - 2;
    pen.fillStyle = agent === 0 ? "rgb(235 20 20)" : "rgb(20 190 20)";
    pen.fillRect(0, bottom - row + 4, 3, row - 4);
    track.forEach(({ text, share }, step) => {
      const [left, right] = [5 + (step / steps) * (width - 5), 5 + ((step + 1) / steps) * (width - 5)];
      const tall = Math.max(2, share * (row - 4));
      pen.fillStyle = `hsl(${(text * 137.5) % 360} 45% 58%)`;
      pen.fillRect(left, bottom - tall, right - left + 0.3, tall);
    });
    const done = card.querySelector(`[data-agent="${agent}"]`).dataset.done;
    if (done !== undefined) {
      pen.fillStyle = "#000";
      pen.fillRect(5 + (Number(done) / steps) * (width - 5) - 1, bottom - row + 4, 2, row - 4);
    }
  });
  pen.fillStyle = getComputedStyle(card).color;
  pen.fillRect(5 + (frame / (steps * FRAMES_PER_STEP)) * (width - 5), 0, 1, height);
}

function show(card, tracks) {
  const video = card.querySelector("video");
  const frame = frameOf(video);
  const step = stepOf(frame);
  tracks.forEach((track, agent) => {
    const now = track[step];
    const place = card.querySelector(`[data-agent="${agent}"]`);
    write(place.querySelector(".subgoal"), now ? texts[now.text] : "–");
    place.querySelector(".share").textContent = now ? `${Math.round(now.share * 100)} % of particles` : "";
  });
  card.querySelector("output").textContent = `${video.currentTime.toFixed(2)} s · step ${step} · frame ${frame}`;
  draw(card, tracks, frame);
}

const play = (video) => { const started = video.play(); if (started) started.catch(() => {}); };

// Cards get their controls when they first come near the window, so that five hundred cost nothing at once.
function control(card) {
  const video = card.querySelector("video");
  const toggle = card.querySelector(".toggle");
  const tracks = (events[card.dataset.id] || []).map(unroll);
  const last = Number(card.dataset.steps) * FRAMES_PER_STEP;
  // The middle of a frame: its edge may show the one before.
  const seek = (frame) => {
    video.pause();
    video.currentTime = (Math.min(Math.max(frame, 0), last) + 0.5) / FRAMES_PER_SECOND;
  };
  const move = (frames) => seek(frameOf(video) + frames);
  const follow = () => {
    show(card, tracks);
    const running = !video.paused && !video.ended;
    toggle.textContent = running ? "❚❚" : "▶";
    toggle.setAttribute("aria-label", running ? "pause" : "play");
    if (running) requestAnimationFrame(follow);
  };
  for (const name of ["play", "pause", "seeked", "ended"]) video.addEventListener(name, follow);
  const playOrPause = () => (video.paused || video.ended ? play(video) : video.pause());
  toggle.addEventListener("click", playOrPause);
  video.addEventListener("click", playOrPause);
  const moves = { back: -1, next: 1, "step-back": -FRAMES_PER_STEP, "step-next": FRAMES_PER_STEP };
  for (const [name, frames] of Object.entries(moves)) {
    card.querySelector("." + name).addEventListener("click", () => move(frames));
  }
  card.querySelector(".timeline").addEventListener("click", (event) => {
    seek(Math.floor(((event.offsetX - 5) / (event.target.clientWidth - 5)) * last));
  });
  card.addEventListener("keydown", (event) => {
    if (event.target !== card) return;
    const frames = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (frames) move(event.shiftKey ? frames * FRAMES_PER_STEP : frames);
    else if (event.key === " ") playOrPause();
    else return;
    event.preventDefault();
  });
  follow();
}

// Videos are loaded near the window and let go of far from it: browsers keep only so many at a time.
const playButton = document.getElementById("play");
const inView = new Set();
const playing = () => playButton.getAttribute("aria-pressed") === "true";
const observer = new IntersectionObserver((entries) => {
  for (const { target, isIntersecting } of entries) {
    const video = target.querySelector("video");
    if (isIntersecting) {
      inView.add(video);
      if (!target.dataset.ready) {
        target.dataset.ready = "yes";
        control(target);
      }
      if (!video.hasAttribute("src")) {
        video.preload = "metadata";
        video.src = video.dataset.src;
      }
      if (playing()) play(video);
    } else if (inView.delete(video)) {
      video.pause();
      video.removeAttribute("src");
      video.load();
    }
  }
}, { rootMargin: "300px" });
cards.forEach((card) => observer.observe(card));

playButton.addEventListener("click", () => {
  playButton.setAttribute("aria-pressed", String(!playing()));
  for (const video of inView) playing() ? play(video) : video.pause();
});

const filters = [...document.querySelectorAll("[data-filter]")];
function filter() {
  const fits = (card, { dataset, value }) => !value || card.dataset[dataset.filter].split("|").includes(value);
  for (const card of cards) card.hidden = !filters.every((choice) => fits(card, choice));
  const count = cards.filter((card) => !card.hidden).length;
  document.getElementById("shown").textContent = `${count} of ${cards.length} events shown`;
}
filters.forEach((choice) => choice.addEventListener("change", filter));
document.getElementById("reset").addEventListener("click", () => {
  for (const choice of filters) choice.value = "";
  filter();
});
filter();
