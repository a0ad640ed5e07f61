// A worker that reads a video. Messages: {picture, width, height, seconds}, answered by {}, and {finish: name}, answered by {result}, where
// null asks for the same pictures once more. Every answer may be {error} instead.
import init, { VideoTracker } from "./phase.js";

const ready = init();
let tracker = null;

onmessage = async ({ data }) => {
  await ready;
  try {
    tracker ??= new VideoTracker();
    if (data.picture) {
      tracker.push(data.width, data.height, new Uint8Array(data.picture), data.seconds);
      postMessage({});
    } else {
      postMessage({ result: tracker.finish(data.finish) ?? null });
    }
  } catch (error) {
    postMessage({ error: error.message });
  }
};
