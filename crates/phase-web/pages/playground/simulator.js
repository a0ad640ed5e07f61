// A worker that simulates. Messages: {start: {scene, seed, options}} and {step: [action or -1, action or -1]}; every one is answered
// by {run, frames, row, report, views, beliefs, took}, with the number of the start that it belongs to, or by {run, error}.
import init, { Simulation } from "./phase.js";

const ready = init();
let simulation = null;
let run = 0;

function answer(took) {
  const views = [simulation.view(0), simulation.view(1)];
  const beliefs = [simulation.belief(0), simulation.belief(1)];
  const frames = simulation.frames();
  const row = simulation.row();
  const report = JSON.parse(simulation.report());
  const moved = [frames.buffer, row.buffer, ...views.map((it) => it.buffer), ...beliefs.map((it) => it.buffer)];
  postMessage({ run, frames, row, report, views, beliefs, took }, moved);
}

onmessage = async ({ data }) => {
  await ready;
  try {
    if (data.start) {
      run = data.run;
      simulation?.free();
      simulation = null;
      const { scene, seed, options } = data.start;
      simulation = new Simulation(scene, BigInt(seed), JSON.stringify(options));
      answer(0);
    } else if (data.step && data.run === run && simulation) {
      const begun = performance.now();
      simulation.step(data.step[0], data.step[1]);
      answer(performance.now() - begun);
    } else if (data.document && simulation) {
      postMessage({ run, document: simulation.document(data.document) });
    }
  } catch (error) {
    postMessage({ run, error: error.message });
  }
};
