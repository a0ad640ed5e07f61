// The three rating forms of PHASE.
//
// - `interactions`: Experiment 1 of the paper, which of its 23 types of interaction a video shows, several at once.
// - `goals`: the second part of Experiment 2, the goals of both agents, their relation, and how likely people would behave like this under these goals, 1 to 5.
// - `relation`: the three-way judgement of Malik and Isik (2023), friendly, neutral or adversarial.
//
// What is asked is data that `phase study` reads too; how it is shown is shared with its page. The bundle (`npm run build`) has both.

import data from "../../../../../../data/forms.json" with { type: "json" };
import * as html from "../../../../pages/study/forms.js";

export const version = "0.1.0";

/** The 23 types of interaction of the paper, in its order: each a `value` and a `text`. */
export const INTERACTIONS = data.choices.interactions;

/** The questions of a form about a video with so many objects (0 to 2): `name`, `text`, `kind` (`many`, `one` or `list`) and `choices`. */
export function questions(form, { objects = 2 } = {}) {
  const asked = Object.hasOwn(data.forms, form) ? data.forms[form] : null;
  if (!asked) throw new Error(`a form is ${Object.keys(data.forms).join(", ")}, not ${form}`);
  const offered = (choices) => data.choices[choices].filter((choice) => (choice.objects ?? 0) <= objects).map(({ value, text }) => ({ value, text }));
  return asked.map((question) => ({ ...question, choices: offered(question.choices) }));
}

/** What is missing or wrong in an answer, as a sentence; null if nothing is. */
export function problem(form, answer, options) {
  return html.problem(questions(form, options), answer)?.sentence ?? null;
}

/**
 * Whether an answer passes a catch trial. `expected` has by question an answer or a list of them: of a question with one answer it is
 * among those expected, of one with several all that are expected are among it. `phase study` has the same rule; test/catch_trials.json
 * holds both to it.
 */
export function passed(expected, answer) {
  return Object.entries(expected).every(([name, wanted]) => {
    const [given, right] = [answer?.[name], [wanted].flat()];
    return Array.isArray(given) ? right.every((choice) => given.includes(choice)) : right.includes(given);
  });
}

/**
 * Puts a form into a container. `submitted` is called with the answer once everything is answered: `interactions` is a list, everything
 * else a string. `shuffle` changes the order of the interactions: a function from a list to a list.
 */
export function render(container, form, { objects = 2, button = "Continue", shuffle, submitted }) {
  return html.render(container, questions(form, { objects }), { button, buttonClass: "jspsych-btn phase-continue", shuffle, submitted });
}
