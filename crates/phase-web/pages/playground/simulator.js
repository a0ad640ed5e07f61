// A worker that simulates. Messages: {start: {scene, seed, options}} and {step: [action or -1, action or -1]}; every one is answered
// by {run, frames, row, report, views, beliefs, took}, with the number of the start that it belongs to, or by {run, error}.
import init, { Show } from "./phase.js";

const ready = init();
let show = null;
let run = 0;

function answer(took) {
  const views = [show.view(0), show.view(1)];
  const beliefs = [show.belief(0), show.belief(1)];
  const frames = show.frames();
  const row = show.row();
  const report = JSON.parse(show.report());
  const moved = [frames.buffer, row.buffer, ...views.map((it) => it.buffer), ...beliefs.map((it) => it.buffer)];
  postMessage({ run, frames, row, report, views, beliefs, took }, moved);
}

onmessage = async ({ data }) => {
  await ready;
  try {
    if (data.start) {
      run = data.run;
      show?.free();
      show = null;
      const { scene, seed, options } = data.start;
      show = new Show(scene, BigInt(seed), JSON.stringify(options));
      answer(0);
    } else if (data.step && data.run === run && show) {
      const begun = performance.now();
      show.step(data.step[0], data.step[1]);
      answer(performance.now() - begun);
    } else if (data.document && show) {
      postMessage({ run, document: show.document(data.document) });
    }
  } catch (error) {
    postMessage({ run, error: error.message });
  }
};
