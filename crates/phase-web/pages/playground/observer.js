// A worker that infers. Messages: {start: {scene, row}} and {row, step}; a row is answered by {run, step, answer}, or by {run, error}.
import init, { Observer } from "./phase.js";

// Decisions that are spent on a row at most.
const DECISIONS = 10;
const ready = init();
let observer = null;
let run = 0;

onmessage = async ({ data }) => {
  await ready;
  try {
    if (data.start) {
      run = data.run;
      observer?.free();
      observer = null;
      observer = new Observer(data.start.scene, data.start.row, DECISIONS);
    } else if (data.row && data.run === run && observer) {
      postMessage({ run, step: data.step, answer: JSON.parse(observer.push(data.row)) });
    }
  } catch (error) {
    postMessage({ run, error: error.message });
  }
};
