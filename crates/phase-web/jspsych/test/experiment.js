// An experiment with all three forms; ?simulate lets jsPsych answer itself.
const jsPsych = initJsPsych({ on_finish: () => { window.finished = jsPsych.data.get().values(); } });
const video = new URLSearchParams(location.search).get("video") ?? "/test/none.mp4";
const timeline = [
  { type: jsPsychPhaseVideo, video, prompt: "Watch <b>this</b>.", replays: 1 },
  { type: jsPsychPhaseRating, form: "interactions", event: "demo-0000" },
  { type: jsPsychPhaseRating, form: "goals", event: "demo-0000", objects: 1 },
  { type: jsPsychPhaseRating, form: "relation", event: "demo-0000", expected: { relation: "neutral" } },
];
if (location.search.includes("simulate")) jsPsych.simulate(timeline, "data-only");
else jsPsych.run(timeline);
