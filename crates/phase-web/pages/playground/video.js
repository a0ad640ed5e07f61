// Videos: the browser decodes them picture by picture, a worker finds what moves, and its tracks are drawn over the pictures.

const LONGEST = 120; // seconds that are read
const MOST_FRAMES_PER_SECOND = 60;
const TAIL = 2; // seconds of path that are drawn

const event = (target, name) => new Promise((resolve, reject) => {
  target.addEventListener(name, resolve, { once: true });
  target.addEventListener("error", () => reject(new Error("this browser cannot decode it")), { once: true });
});

async function seek(video, seconds) {
  const done = event(video, "seeked");
  video.currentTime = seconds;
  await done;
}

/** Time from frame to frame (s), as frames say while they are played. */
async function interval(video) {
  const times = [];
  await new Promise((resolve, reject) => {
    const next = (_, { mediaTime }) => {
      times.push(mediaTime);
      if (times.length < 16) video.requestVideoFrameCallback(next);
      else resolve();
    };
    video.requestVideoFrameCallback(next);
    video.onended = resolve;
    setTimeout(resolve, 4000);
    video.playbackRate = 0.5;
    video.play().catch(reject);
  });
  video.pause();
  video.playbackRate = 1;
  const steps = times.slice(1).map((time, k) => time - times[k]).filter((step) => step > 1e-3);
  const least = Math.min(...steps);
  const single = steps.filter((step) => step < 1.5 * least);
  const mean = single.reduce((sum, step) => sum + step, 0) / single.length;
  return Math.max(mean || 0.05, 1 / MOST_FRAMES_PER_SECOND);
}

export class Film {
  /** Reads a file; `progress` is told the share that is done. Throws a sentence. */
  static async read(file, progress) {
    const video = document.createElement("video");
    [video.muted, video.playsInline, video.preload] = [true, true, "auto"];
    const loaded = event(video, "loadeddata");
    video.src = URL.createObjectURL(file);
    await loaded;
    if (!(video.duration <= LONGEST)) throw new Error(`videos of up to ${LONGEST} s are read here; phase track reads longer ones`);
    const step = await interval(video);
    const frames = Math.max(1, Math.round(video.duration / step));
    const [width, height] = [video.videoWidth, video.videoHeight];
    const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
    const worker = new Worker(new URL("tracker.js", import.meta.url), { type: "module" });
    const ask = async (message, moved = []) => {
      const answered = event(worker, "message");
      worker.postMessage(message, moved);
      const { data } = await answered;
      if (data.error) throw new Error(data.error);
      return data.result;
    };
    try {
      let result = null;
      for (let pass = 0; result === null; pass += 1) {
        for (let k = 0; k < frames; k += 1) {
          await seek(video, Math.min((k + 0.5) * step, video.duration));
          context.drawImage(video, 0, 0);
          const picture = context.getImageData(0, 0, width, height).data.buffer;
          await ask({ picture, width, height, seconds: k * step }, [picture]);
          progress(pass, (k + 1) / frames);
        }
        result = await ask({ finish: file.name.replace(/\.[^.]*$/, "") });
      }
      const track = JSON.parse(result);
      await seek(video, 0);
      return new Film(video, track, (frames - track.seconds.length) * step);
    } catch (error) {
      URL.revokeObjectURL(video.src);
      throw error;
    } finally {
      worker.terminate();
    }
  }

  constructor(video, track, lead) {
    this.video = video;
    /** The event without labels, as a file. */
    this.document = track.document;
    /** What cannot be judged, as sentences. */
    this.notes = track.notes;
    this.bodies = track.bodies;
    this.seconds = track.seconds;
    /** Time before the first frame of the track (s). */
    this.lead = lead;
  }

  /** Time of the track that is shown (s). */
  get time() {
    return Math.max(0, this.video.currentTime - this.lead);
  }

  /** Plays, or shows a time (s). */
  show(playing, seconds) {
    if (playing && this.video.paused) this.video.play().catch(() => {});
    if (!playing && !this.video.paused) this.video.pause();
    if (!playing && !this.video.seeking && Math.abs(this.time - seconds) > 0.02) this.video.currentTime = seconds + this.lead;
  }

  /** Draws the picture and the tracks up to a time (s), as large as they fit. */
  draw(context, seconds) {
    const { width, height } = context.canvas;
    const [across, down] = [this.video.videoWidth, this.video.videoHeight];
    const scale = Math.min(width / across, height / down);
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, width, height);
    context.setTransform(scale, 0, 0, scale, (width - scale * across) / 2, (height - scale * down) / 2);
    context.drawImage(this.video, 0, 0);
    const after = this.seconds.findIndex((time) => time > seconds + 1e-6);
    const now = (after < 0 ? this.seconds.length : after) - 1;
    const from = this.seconds.findIndex((time) => time >= seconds - TAIL);
    for (const { colour, radius, agent, path } of this.bodies) {
      const line = new Path2D();
      for (const [x, y] of path.slice(Math.max(0, from), now + 1)) line.lineTo(x, y);
      const [x, y, angle] = path[Math.max(0, now)];
      if (agent) {
        const corner = (right, ahead) => [
          x + radius * (Math.cos(angle) * right - Math.sin(angle) * ahead),
          y - radius * (Math.sin(angle) * right + Math.cos(angle) * ahead),
        ];
        line.moveTo(...corner(-1.5, -1));
        for (const [right, ahead] of [[-0.5, 1], [0.5, 1], [1.5, -1], [-1.5, -1]]) line.lineTo(...corner(right, ahead));
      } else {
        line.moveTo(x + radius, y);
        line.arc(x, y, radius, 0, 2 * Math.PI);
      }
      for (const [style, thick] of [["#000", 4], ["#fff", 2.6], [`rgb(${colour})`, 1.2]]) {
        [context.strokeStyle, context.lineWidth] = [style, thick / scale];
        context.stroke(line);
      }
    }
    context.setTransform(1, 0, 0, 1, 0, 0);
  }

  close() {
    this.video.pause();
    URL.revokeObjectURL(this.video.src);
  }
}
