// A worker that infers. Messages: {start: {scene, row}} or {start: {file, index}}, and {row, step}; a row is answered by {run, step, answer}, or by {run, error}.
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
      const { scene, row, file, index } = data.start;
      observer = file ? Observer.ofEvent(file, index, DECISIONS) : new Observer(scene, row, DECISIONS);
    } else if (data.row && data.run === run && observer) {
      postMessage({ run, step: data.step, answer: JSON.parse(observer.push(data.row)) });
    }
  } catch (error) {
    postMessage({ run, error: error.message });
  }
};
