import { passed, problem, questions, render } from "@phase-events/forms";
import { ParameterType } from "jspsych";

const info = {
  name: "phase-rating",
  version: "0.1.0",
  parameters: {
    /** Which form: `interactions`, `goals` or `relation`. */
    form: { type: ParameterType.SELECT, options: ["interactions", "goals", "relation"], default: "relation" },
    /** Id of the event that is rated; it is only kept with the answer. */
    event: { type: ParameterType.STRING, default: undefined },
    /** How many objects the video shows, 0 to 2: which goals are offered. */
    objects: { type: ParameterType.INT, default: 2 },
    /** Whether the types of interaction are in another order each time. */
    shuffle: { type: ParameterType.BOOL, default: true },
    /** Text above the questions, as text and not as HTML. */
    prompt: { type: ParameterType.STRING, default: "" },
    /**
     * The right answer of a catch trial, such as `{relation: "neutral"}`: by question one of the right choices or a list of them, for
     * `interactions` all that must be ticked. Null for a trial that has none.
     */
    expected: { type: ParameterType.OBJECT, default: null },
    /** Text of the button that goes on. */
    button_label: { type: ParameterType.STRING, default: "Continue" },
  },
  data: {
    /** The form. */
    form: { type: ParameterType.STRING },
    /** Id of the event. */
    event: { type: ParameterType.STRING },
    /** The answer by question: `interactions` is a list, everything else a string. */
    response: { type: ParameterType.OBJECT },
    /** Time until the answer (ms). */
    rt: { type: ParameterType.INT },
    /** Of a catch trial, whether it was passed, by the rule of `phase study`; null otherwise. */
    correct: { type: ParameterType.BOOL },
  },
  citations: {
    apa: "Netanyahu, A., Shu, T., Katz, B., Barbu, A., & Tenenbaum, J. B. (2021). PHASE: PHysically-grounded Abstract Social Events for Machine Social Perception. Proceedings of the AAAI Conference on Artificial Intelligence, 35(1), 845-853.",
    bibtex: "@inproceedings{netanyahu2021phase, title = {{PHASE}: PHysically-grounded Abstract Social Events for Machine Social Perception}, author = {Netanyahu, Aviv and Shu, Tianmin and Katz, Boris and Barbu, Andrei and Tenenbaum, Joshua B.}, booktitle = {Proceedings of the AAAI Conference on Artificial Intelligence}, volume = {35}, number = {1}, pages = {845--853}, year = {2021}}",
  },
};

/** **phase-rating**: asks about a social event with one of PHASE's three forms. */
class PhaseRatingPlugin {
  static info = info;

  constructor(jsPsych) {
    this.jsPsych = jsPsych;
  }

  #data(trial, response, rt) {
    const correct = trial.expected ? passed(trial.expected, response) : null;
    return { form: trial.form, event: trial.event, response, rt, correct };
  }

  trial(display_element, trial) {
    const begun = performance.now();
    if (trial.prompt) display_element.append(Object.assign(document.createElement("p"), { textContent: trial.prompt }));
    render(display_element, trial.form, {
      objects: trial.objects,
      button: trial.button_label,
      shuffle: trial.shuffle ? (list) => this.jsPsych.randomization.shuffle(list) : undefined,
      submitted: (response) => {
        display_element.replaceChildren();
        this.jsPsych.finishTrial(this.#data(trial, response, Math.round(performance.now() - begun)));
      },
    });
  }

  simulate(trial, simulation_mode, simulation_options, load_callback) {
    const { randomization, pluginAPI } = this.jsPsych;
    const draw = ({ kind, choices }) => {
      const values = choices.map(({ value }) => value);
      return kind === "many" ? randomization.sampleWithoutReplacement(values, 2).sort() : randomization.sampleWithoutReplacement(values, 1)[0];
    };
    const response = Object.fromEntries(questions(trial.form, trial).map((question) => [question.name, draw(question)]));
    const rt = Math.round(randomization.sampleExGaussian(4000, 500, 1 / 1000, true));
    const data = pluginAPI.mergeSimulationData(this.#data(trial, response, rt), simulation_options);
    pluginAPI.ensureSimulationDataConsistency(trial, data);
    const wrong = problem(trial.form, data.response, trial);
    if (wrong) throw new Error(wrong);
    load_callback();
    const display = this.jsPsych.getDisplayElement();
    if (simulation_mode === "visual") this.trial(display, trial);
    const finish = () => {
      display.replaceChildren();
      this.jsPsych.finishTrial(data);
    };
    if (simulation_mode === "visual") setTimeout(finish, data.rt);
    else this.jsPsych.finishTrial(data);
  }
}

export default PhaseRatingPlugin;
