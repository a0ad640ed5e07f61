// What is thought and inferred, as lists with meters. Text is set as text, never as HTML.

import { choices } from "./phase.js";

const names = () => JSON.parse(choices()).names;

function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  Object.assign(made, attributes);
  made.append(...children);
  return made;
}

function share(label, value, text = `${Math.round(100 * value)} %`) {
  const meter = element("meter", { min: 0, max: 1, value });
  meter.setAttribute("aria-label", label);
  return element("div", { className: "share" }, element("span", { textContent: label }), meter, element("span", { textContent: text }));
}

function two(of) {
  const agents = names().slice(0, 2).map((textContent, agent) =>
    element("div", {}, element("h2", { className: `agent-${agent}`, textContent }), ...of(agent)));
  return element("div", { className: "two" }, ...agents);
}

function note(textContent) {
  return element("p", { className: "small", textContent });
}

/** The posterior of goals, relation and roles; null before there is one. */
export function showPosterior(panel, answer, step) {
  if (!answer) {
    panel.replaceChildren(note("Nothing yet: run the event."));
    return;
  }
  const relation = Object.entries(answer.relation).map(([name, p]) => share(name, p));
  const roles = (agent) => answer.roles
    ? [share("helps the other", answer.roles.helps[agent]), share("hinders the other", answer.roles.hinders[agent])]
    : [];
  panel.replaceChildren(
    note(`After ${(step / 4).toFixed(2)} s, from the motion of the bodies alone.`),
    ...relation,
    two((agent) => [...answer.words[agent].map(({ goal, p }) => share(goal, p)), ...roles(agent)]),
  );
}

/** The reasons of the last decisions; a mind whose agent is controlled by somebody has none. */
export function showThoughts(panel, report) {
  if (!report?.minds) {
    panel.replaceChildren(note("Nothing yet: run the event."));
    return;
  }
  panel.replaceChildren(two((agent) => {
    const { subgoal, subgoals, actions, intents = [], suspicion } = report.minds[agent];
    const particles = subgoals.reduce((sum, it) => sum + it.particles, 0) || 1;
    const visits = actions.reduce((sum, it) => sum + it.visits, 0) || 1;
    const most = [...actions].sort((a, b) => b.visits - a.visits).slice(0, 4);
    return [
      note(`action: ${report.actions[agent]}; goal ${report.goals[agent] ? "holds" : "does not hold"}`),
      note(`subgoal: ${subgoal}`),
      ...subgoals.slice(0, 4).map((it) => share(it.subgoal, it.particles / particles, `V ${it.value.toFixed(2)}`)),
      ...most.map((it) => share(it.action, it.visits / visits, String(it.visits))),
      ...(intents.length > 0 ? [note("the other wants:")] : []),
      ...intents.slice(0, 4).map((it) => share(it.words, it.probability, `${Math.round(100 * it.probability)} %`)),
      ...(suspicion === undefined
        ? []
        : [share("suspects hindrance", suspicion, `${Math.round(100 * suspicion)} %`)]),
    ];
  }));
}
