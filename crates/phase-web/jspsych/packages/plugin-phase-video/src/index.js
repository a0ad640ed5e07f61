import { ParameterType } from "jspsych";

const info = {
  name: "phase-video",
  version: "0.1.0",
  parameters: {
    /** Address of the video, an .mp4 of PHASE. */
    video: { type: ParameterType.VIDEO, default: undefined },
    /** Text above the video, as text and not as HTML. */
    prompt: { type: ParameterType.STRING, default: "" },
    /** What the video shows, for those who cannot see it. */
    description: { type: ParameterType.STRING, default: "Two agents, red and green, move in an arena with coloured landmarks." },
    /** How often it may be watched again; null for as often as one likes. */
    replays: { type: ParameterType.INT, default: null },
    /** Width of the video on the page (pixels). */
    width: { type: ParameterType.INT, default: 480 },
    /** Whether the video begins by itself. Browsers allow that after the first click on a page. */
    autoplay: { type: ParameterType.BOOL, default: true },
    /** Text of the button that goes on. */
    button_label: { type: ParameterType.STRING, default: "Continue" },
  },
  data: {
    /** Address of the video. */
    video: { type: ParameterType.STRING },
    /** Time from the start of the trial until it was left (ms). */
    rt: { type: ParameterType.INT },
    /** How often it was watched to its end. */
    watched: { type: ParameterType.INT },
    /** How often the page was hidden while it played, for example for another tab. */
    hidden: { type: ParameterType.INT },
    /** Length of the video (s); null if it could not be loaded. */
    duration: { type: ParameterType.FLOAT },
    /** Whether it could not be loaded. */
    failed: { type: ParameterType.BOOL },
  },
  citations: {
    apa: "Netanyahu, A., Shu, T., Katz, B., Barbu, A., & Tenenbaum, J. B. (2021). PHASE: PHysically-grounded Abstract Social Events for Machine Social Perception. Proceedings of the AAAI Conference on Artificial Intelligence, 35(1), 845-853.",
    bibtex: "@inproceedings{netanyahu2021phase, title = {{PHASE}: PHysically-grounded Abstract Social Events for Machine Social Perception}, author = {Netanyahu, Aviv and Shu, Tianmin and Katz, Boris and Barbu, Andrei and Tenenbaum, Joshua B.}, booktitle = {Proceedings of the AAAI Conference on Artificial Intelligence}, volume = {35}, number = {1}, pages = {845--853}, year = {2021}}",
  },
};

/** **phase-video**: shows a video of a social event; one goes on once it has been watched to its end. */
class PhaseVideoPlugin {
  static info = info;

  constructor(jsPsych) {
    this.jsPsych = jsPsych;
  }

  trial(display_element, trial) {
    const begun = performance.now();
    const seen = { watched: 0, hidden: 0, failed: false };
    const video = Object.assign(document.createElement("video"), { src: trial.video, width: trial.width, muted: true, playsInline: true });
    video.setAttribute("aria-label", trial.description);
    const button = (label) => Object.assign(document.createElement("button"), { type: "button", className: "jspsych-btn", textContent: label });
    const [play, next] = [button("Play"), button(trial.button_label)];
    const message = Object.assign(document.createElement("p"), { role: "status" });
    next.disabled = true;
    if (trial.prompt) display_element.append(Object.assign(document.createElement("p"), { textContent: trial.prompt }));
    display_element.append(video, message, play, " ", next);

    const start = () => {
      play.disabled = true;
      // Paused in the middle, it goes on from there.
      if (video.ended || !video.currentTime) video.currentTime = 0;
      video.play().catch(() => { play.disabled = false; });
    };
    const hidden = () => { if (document.hidden && !video.paused) seen.hidden += 1; };
    document.addEventListener("visibilitychange", hidden);
    // Whoever pauses it, the browser too: for a call, a key of the keyboard, a page in the background.
    video.onpause = () => {
      if (video.ended) return;
      play.textContent = "Play on";
      play.disabled = false;
    };
    video.onplay = () => { play.disabled = true; };
    video.onended = () => {
      seen.watched += 1;
      next.disabled = false;
      const again = trial.replays === null || seen.watched <= trial.replays;
      play.textContent = "Play again";
      play.disabled = !again;
    };
    video.onerror = () => {
      seen.failed = true;
      message.textContent = "The video cannot be played.";
      [play.disabled, next.disabled] = [true, false];
    };
    play.onclick = start;
    next.onclick = () => {
      document.removeEventListener("visibilitychange", hidden);
      const duration = Number.isFinite(video.duration) ? video.duration : null;
      display_element.replaceChildren();
      this.jsPsych.finishTrial({ video: trial.video, rt: Math.round(performance.now() - begun), duration, ...seen });
    };
    if (trial.autoplay) start();
  }

  simulate(trial, simulation_mode, simulation_options, load_callback) {
    const data = this.jsPsych.pluginAPI.mergeSimulationData({
      video: trial.video, rt: Math.round(this.jsPsych.randomization.sampleExGaussian(15000, 1000, 1 / 2000, true)),
      watched: 1, hidden: 0, duration: 12.5, failed: false,
    }, simulation_options);
    this.jsPsych.pluginAPI.ensureSimulationDataConsistency(trial, data);
    load_callback();
    if (simulation_mode === "data-only") {
      this.jsPsych.finishTrial(data);
      return;
    }
    const display = this.jsPsych.getDisplayElement();
    this.trial(display, trial);
    setTimeout(() => {
      display.replaceChildren();
      this.jsPsych.finishTrial(data);
    }, data.rt);
  }
}

export default PhaseVideoPlugin;
