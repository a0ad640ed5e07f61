// A worker that infers. Messages: {start: {scene, row}} and {row, step}; a row is answered by {run, step, answer}, or by {run, error}.
import init, { Watcher } from "./phase.js";

// Decisions that are spent on a row at most.
const DECISIONS = 10;
const ready = init();
let watcher = null;
let run = 0;

onmessage = async ({ data }) => {
  await ready;
  try {
    if (data.start) {
      run = data.run;
      watcher?.free();
      watcher = null;
      watcher = new Watcher(data.start.scene, data.start.row, DECISIONS);
    } else if (data.row && data.run === run && watcher) {
      postMessage({ run, step: data.step, answer: JSON.parse(watcher.push(data.row)) });
    }
  } catch (error) {
    postMessage({ run, error: error.message });
  }
};
