// Rating forms as HTML that keyboards and screen readers can use. What is asked comes from elsewhere: a question has a `name`, a `text`,
// a `kind` (`many`: boxes to tick, `one`: one of several, `list`: one of a list, `whole`: a number, `text`: a line of text), `choices`
// (each `value` and `text`), and perhaps `optional`, `from`, `to` and `longest`.

/** What is wrong in one answer, as a sentence; null if nothing is. */
function problemOf({ text, kind, choices, optional, from, to, longest }, given) {
  const values = kind === "many" ? given : [given];
  if (!Array.isArray(values) || values.length === 0 || values[0] === undefined || values[0] === null || values[0] === "") {
    return optional ? null : `Please answer: ${text}`;
  }
  if (kind === "whole") {
    const number = Number(given);
    return /^-?\d{1,15}$/.test(String(given)) && number >= from && number <= to ? null : `Please enter a whole number from ${from} to ${to}: ${text}`;
  }
  if (kind === "text") return [...String(given)].length <= longest ? null : `Please write at most ${longest} letters: ${text}`;
  const known = choices.map(({ value }) => value);
  const unknown = values.find((value) => !known.includes(String(value)));
  return unknown === undefined ? null : `There is no choice ${unknown}: ${text}`;
}

/** The first question that is not answered well: `name` and the problem as a `sentence`; null if there is none. */
export function problem(questions, answer) {
  for (const question of questions) {
    const sentence = problemOf(question, answer?.[question.name]);
    if (sentence) return { name: question.name, sentence };
  }
  return null;
}

function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [attribute, value] of Object.entries(attributes)) made.setAttribute(attribute, value);
  made.append(...children);
  return made;
}

function field({ name, text, kind, choices, optional, from, to, longest }, id, shuffle) {
  const asked = optional ? `${text} (optional)` : text;
  if (kind === "many" || kind === "one") {
    const group = element("fieldset", { class: `phase-question phase-${kind}` }, element("legend", {}, asked));
    for (const { value, text: label } of kind === "many" ? shuffle([...choices]) : choices) {
      group.append(element("label", {}, element("input", { type: kind === "many" ? "checkbox" : "radio", name, value }), " ", label));
    }
    return group;
  }
  let input;
  if (kind === "list") {
    input = element("select", { name, id }, element("option", { value: "" }, "Choose …"));
    input.append(...choices.map(({ value, text: label }) => element("option", { value }, label)));
  } else if (kind === "whole") {
    input = element("input", { name, id, type: "number", inputmode: "numeric", step: "1", min: from, max: to });
  } else {
    input = element("input", { name, id, type: "text", maxlength: 2 * longest, autocomplete: "off" });
  }
  return element("p", { class: "phase-question" }, element("label", { for: id }, asked), " ", input);
}

let forms = 0;

/**
 * Puts questions into a container. `submitted` is called with the answer once everything is answered: a list for the kind `many`, a
 * number for `whole`, else a text; what is optional and left out is absent. `shuffle` changes the order of boxes to tick: a function
 * from a list to a list. `ready` may object to an answer with a sentence (such as that the video has not been watched).
 */
export function render(container, questions, { button = "Continue", buttonClass = "phase-continue", shuffle = (list) => list, ready = () => null, submitted }) {
  const id = `phase-form-${(forms += 1)}`;
  const made = element("form", { class: "phase-form", novalidate: "" });
  made.append(...questions.map((question) => field(question, `${id}-${question.name}`, shuffle)));
  const message = element("p", { class: "phase-problem", role: "alert" });
  made.append(message, element("button", { type: "submit", class: buttonClass }, button));
  made.addEventListener("submit", (event) => {
    event.preventDefault();
    const data = new FormData(made);
    const given = questions.map(({ name, kind }) => [name, kind === "many" ? data.getAll(name).sort() : (data.get(name) ?? "").trim()]);
    const answer = Object.fromEntries(given.filter(([, value]) => value.length > 0));
    const wrong = problem(questions, answer);
    message.textContent = wrong?.sentence ?? ready() ?? "";
    if (wrong) {
      const input = made.elements.namedItem(wrong.name);
      (input instanceof Element ? input : input?.[0])?.focus();
    }
    if (message.textContent) return;
    for (const { name, kind } of questions) if (kind === "whole" && name in answer) answer[name] = Number(answer[name]);
    submitted(answer);
  });
  container.append(made);
  return made;
}
