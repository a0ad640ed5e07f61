// The three rating forms of PHASE, as data and as HTML that keyboards and screen readers can use.
//
// - `interactions`: Experiment 1 of the paper, which of 23 types of interaction a video shows, several at once. The paper does not print
//   its list; this one is ours, put together from the sources that it names (Gao et al. 2011; Gordon and Roemmele 2014).
// - `goals`: the second part of Experiment 2, the goals of both agents, their relation, and how likely people would behave like this under these goals, 1 to 5.
// - `relation`: the three-way judgement of Malik and Isik (2023), friendly, neutral or adversarial.

export const version = "0.1.0";

/** The 23 types of interaction: name and text. */
export const INTERACTIONS = [
  ["approaching", "approaching the other"], ["avoiding", "avoiding the other"], ["chasing", "chasing"], ["fleeing", "fleeing"],
  ["following", "following"], ["leading", "leading the way"], ["helping", "helping"], ["collaborating", "collaborating"],
  ["carrying together", "carrying something together"], ["giving", "giving or handing over"], ["making way", "making way"],
  ["protecting", "protecting or guarding"], ["hindering", "hindering"], ["blocking", "blocking the way"], ["stealing", "stealing or taking away"],
  ["hiding", "hiding something"], ["competing", "competing"], ["fighting", "fighting or struggling over something"], ["pushing", "pushing the other around"],
  ["playing", "playing"], ["searching", "searching"], ["crossing paths", "crossing paths by accident"], ["ignoring", "each minding its own business"],
];

export const RELATIONS = [["friendly", "friendly"], ["neutral", "neutral"], ["adversarial", "adversarial"]];

const LANDMARKS = ["blue", "green", "red", "yellow"];
const OBJECTS = ["light blue", "pink"];

/** The goals that an agent can be said to have, with so many objects in the video (0 to 2): name and text. */
export function goals(objects = 2) {
  const places = LANDMARKS.map((landmark) => [`agent on ${landmark}`, `to be on the ${landmark} landmark`]);
  const carried = OBJECTS.slice(0, objects).flatMap((object) =>
    LANDMARKS.map((landmark) => [`${object} on ${landmark}`, `the ${object} object on the ${landmark} landmark`]));
  const touch = [["touch", "to touch the other agent"], ["get away", "to get away from the other agent"]];
  const social = [["help", "to help the other agent with its goal"], ["hinder", "to keep the other agent from its goal"]];
  return [...places, ...carried, ...touch, ...social, ["none", "no goal that I can see"]];
}

const LIKELY = [["1", "1, very unlikely"], ["2", "2"], ["3", "3"], ["4", "4"], ["5", "5, very likely"]];

/** The questions of a form: `name`, `text`, `kind` (`many`, `one` or `list`) and `choices`. */
export function questions(form, { objects = 2 } = {}) {
  const relation = { name: "relation", text: "How do the two agents stand to each other?", kind: "one", choices: RELATIONS };
  switch (form) {
    case "interactions":
      return [{ name: "interactions", text: "Which of these does the video show? Choose all that apply.", kind: "many", choices: INTERACTIONS }];
    case "goals":
      return [
        { name: "goal_0", text: "What is the goal of the red agent?", kind: "list", choices: goals(objects) },
        { name: "goal_1", text: "What is the goal of the green agent?", kind: "list", choices: goals(objects) },
        relation,
        { name: "human_likeness", text: "How likely would people behave like this if they had these goals?", kind: "one", choices: LIKELY },
      ];
    case "relation":
      return [relation];
    default:
      throw new Error(`a form is interactions, goals or relation, not ${form}`);
  }
}

/** What is missing or wrong in an answer, as a sentence; null if nothing is. */
export function problem(form, answer, options) {
  for (const { name, text, kind, choices } of questions(form, options)) {
    const given = answer?.[name];
    const values = kind === "many" ? given : [given];
    if (!Array.isArray(values) || values.length === 0 || values[0] === undefined || values[0] === "") return `Please answer: ${text}`;
    const names = choices.map(([value]) => value);
    const unknown = values.find((value) => !names.includes(String(value)));
    if (unknown !== undefined) return `${name}: there is no choice ${unknown}`;
  }
  return null;
}

function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [attribute, value] of Object.entries(attributes)) made.setAttribute(attribute, value);
  made.append(...children);
  return made;
}

let forms = 0;

/**
 * Puts a form into a container. `submitted` is called with the answer once everything is answered: `interactions` is a list, everything
 * else a string. `shuffle` changes the order of the interactions: a function from a list to a list.
 */
export function render(container, form, { objects = 2, button = "Continue", shuffle = (list) => list, submitted }) {
  const asked = questions(form, { objects });
  const id = `phase-form-${(forms += 1)}`;
  const made = element("form", { class: "phase-form", novalidate: "" });
  for (const { name, text, kind, choices } of asked) {
    if (kind === "list") {
      const list = element("select", { name, id: `${id}-${name}` }, element("option", { value: "" }, "Choose …"));
      list.append(...choices.map(([value, label]) => element("option", { value }, label)));
      made.append(element("p", { class: "phase-question" }, element("label", { for: list.id }, text), " ", list));
      continue;
    }
    const group = element("fieldset", { class: `phase-question phase-${kind}` }, element("legend", {}, text));
    for (const [value, label] of kind === "many" ? shuffle([...choices]) : choices) {
      const input = element("input", { type: kind === "many" ? "checkbox" : "radio", name, value });
      group.append(element("label", {}, input, " ", label));
    }
    made.append(group);
  }
  const message = element("p", { class: "phase-problem", role: "alert" });
  made.append(message, element("button", { type: "submit", class: "jspsych-btn phase-continue" }, button));
  made.addEventListener("submit", (event) => {
    event.preventDefault();
    const data = new FormData(made);
    const answer = Object.fromEntries(asked.map(({ name, kind }) => [name, kind === "many" ? data.getAll(name).sort() : (data.get(name) ?? "")]));
    const wrong = problem(form, answer, { objects });
    message.textContent = wrong ?? "";
    if (wrong) {
      const missing = asked.find(({ name }) => wrong.endsWith(asked.find((it) => it.name === name).text));
      made.elements.namedItem(missing?.name)?.[0]?.focus?.();
    } else {
      submitted(answer);
    }
  });
  container.append(made);
  return made;
}
