// The form of a scene. It holds the scene as it stands in files and says when somebody has changed it.
import { choices, describeScene, goals } from "./phase.js";

const RADII = [0.8, 1.2, 1.6, 1.01];
const FORCES = [150, 300, 450, 600];
const KNOWLEDGE = [["goals", "known"], [0, "unknown, ignored"], [1, "unknown, inferred"], [2, "unknown, inferred by both"]];
const ATTITUDES = [["1", "helps the other"], ["0", "minds its own goal"], ["-1", "hinders the other"]];

const byId = (id) => document.getElementById(id);

function labelled(text, control, className = "") {
  const label = document.createElement("label");
  label.className = className;
  label.append(text, " ", control);
  return label;
}

function select(options, value) {
  const made = document.createElement("select");
  for (const [optionValue, text] of options) made.append(new Option(text, optionValue, false, String(optionValue) === String(value)));
  return made;
}

function number(value, step) {
  const made = document.createElement("input");
  made.type = "number";
  made.step = String(step);
  made.value = String(Math.round(value * 100) / 100);
  return made;
}

export class Editor {
  /** The scene as it stands in files; always valid. */
  scene = null;
  /** What `describeScene` says of it. */
  description = null;
  /** Who decides for each agent: "mind" or "keys". */
  control = ["mind", "mind"];
  #changed;
  #complain;

  constructor(changed, complain) {
    this.#changed = changed;
    this.#complain = complain;
    const { kinds, layouts, names } = JSON.parse(choices());
    this.names = names;
    byId("kind").replaceChildren(...kinds.map((kind) => new Option(kind.name)));
    const variants = () => {
      const kind = kinds.find((it) => it.name === byId("kind").value);
      byId("variant").replaceChildren(new Option("any", ""), ...kind.variants.map((name) => new Option(name)));
    };
    byId("kind").addEventListener("change", variants);
    variants();
    byId("layout").replaceChildren(...layouts.map((base) => new Option(base)));
    byId("layout").addEventListener("change", () => this.#edit((scene) => { scene.layout.base = Number(byId("layout").value); }));
    byId("flip").addEventListener("change", () => this.#edit((scene) => {
      const flip = byId("flip").value;
      scene.layout.flip = flip === "" ? null : Number(flip);
    }));
    byId("objects").addEventListener("change", () => this.#setObjects(Number(byId("objects").value)));
  }

  /** Takes a scene; the form shows it. Throws what is wrong with it. */
  take(scene) {
    const description = JSON.parse(describeScene(JSON.stringify(scene)));
    this.description = description;
    this.scene = description.scene;
    this.#show();
  }

  /** The start of a body: agents 0 and 1, objects 2 and 3. */
  start(body) {
    return body < 2 ? this.scene.agents[body].start : this.scene.objects[body - 2]?.start;
  }

  /** Puts a body elsewhere; false, and nothing happens, where it cannot be. */
  move(body, change) {
    return this.#edit((scene) => Object.assign(body < 2 ? scene.agents[body].start : scene.objects[body - 2].start, change));
  }

  #edit(change) {
    const scene = structuredClone(this.scene);
    change(scene);
    settle(scene);
    try {
      const { overlap, kind } = JSON.parse(describeScene(JSON.stringify(scene)));
      scene.event = kind;
      if (overlap && !this.description.overlap) throw new Error(overlap);
      this.take(scene);
    } catch (error) {
      this.#complain(error.message);
      this.#show();
      return false;
    }
    this.#changed();
    return true;
  }

  #setObjects(count) {
    const places = [14, 18, 11, 21, 8, 24].flatMap((x) => [16, 8, 19, 5, 13, 11].map((y) => [x, y]));
    const scene = structuredClone(this.scene);
    scene.objects.length = Math.min(scene.objects.length, count);
    while (scene.objects.length < count) {
      const fits = places.some(([x, y]) => {
        const start = { x, y, vx: 0, vy: 0, angle: 0, angular_velocity: 0 };
        const more = structuredClone(scene);
        more.objects.push({ radius: RADII[0], size_level: 0, start });
        try {
          if (JSON.parse(describeScene(JSON.stringify(more))).overlap) return false;
        } catch {
          return false;
        }
        scene.objects = more.objects;
        return true;
      });
      if (!fits) break;
    }
    this.#edit((edited) => { edited.objects = scene.objects; });
  }

  #show() {
    const { scene } = this;
    byId("layout").value = String(scene.layout.base);
    byId("flip").value = scene.layout.flip === null || scene.layout.flip === undefined ? "" : String(scene.layout.flip);
    byId("objects").value = String(scene.objects.length);
    const focused = document.activeElement?.dataset?.field;
    byId("agents").replaceChildren(...[0, 1].map((agent) => this.#agent(agent)));
    byId("sizes").replaceChildren(...scene.objects.flatMap((_, k) => this.#object(k)));
    if (focused) document.querySelector(`[data-field="${focused}"]`)?.focus();
  }

  #field(control, name, change) {
    control.dataset.field = name;
    control.addEventListener("change", () => this.#edit((scene) => change(scene, control.value)));
    return control;
  }

  #place(body) {
    const start = this.start(body);
    const at = (name, step) => this.#field(number(start[name], step), `${name}-${body}`, (scene, value) => {
      (body < 2 ? scene.agents[body] : scene.objects[body - 2]).start[name] = Number(value);
    });
    const places = [labelled("x (u)", at("x", 0.5)), labelled("y (u)", at("y", 0.5))];
    if (body >= 2) return places;
    const degrees = this.#field(number((start.angle * 180) / Math.PI, 5), `angle-${body}`, (scene, value) => {
      scene.agents[body].start.angle = (Number(value) * Math.PI) / 180;
    });
    return [...places, labelled("turned (°)", degrees)];
  }

  #agent(agent) {
    const spec = this.scene.agents[agent];
    const size = this.#field(select(RADII.map((radius, k) => [k, `${radius} u`]), spec.size_level), `size-${agent}`, (scene, value) => {
      Object.assign(scene.agents[agent], { size_level: Number(value), radius: RADII[value] });
    });
    const strength = this.#field(select(FORCES.map((force, k) => [k, `${force} N`]), spec.strength_level), `strength-${agent}`, (scene, value) => {
      Object.assign(scene.agents[agent], { strength_level: Number(value), max_force: FORCES[value] });
    });
    const known = JSON.parse(goals(agent, this.scene.objects.length)).map(({ goal, words }) => [JSON.stringify(goal), words]);
    const own = known.find(([goal]) => same(JSON.parse(goal), spec.goal))?.[0];
    if (own === undefined) known.push([JSON.stringify(spec.goal), this.description.goals[agent]]);
    const goal = this.#field(select(known, own ?? JSON.stringify(spec.goal)), `goal-${agent}`, (scene, value) => {
      scene.agents[agent].goal = JSON.parse(value);
    });
    goal.disabled = spec.alpha !== 0;
    goal.title = goal.disabled ? "A helper has the other agent's goal, a hinderer its opposite." : "";
    const attitude = this.#field(select(ATTITUDES, spec.alpha), `attitude-${agent}`, (scene, value) => {
      scene.agents[agent].alpha = Number(value);
    });
    const mind = spec.knows === "nothing" ? spec.level ?? 1 : "goals";
    const knows = this.#field(select(KNOWLEDGE, mind), `knows-${agent}`, (scene, value) => {
      const { knows, level, ...rest } = scene.agents[agent];
      scene.agents[agent] = value === "goals" ? rest : { ...rest, knows: "nothing", level: Number(value) };
    });
    knows.title = "What it knows of the other's goal at the start.";
    const control = select([["mind", "its mind"], ["keys", "you, by keys"]], this.control[agent]);
    control.dataset.field = `control-${agent}`;
    control.addEventListener("change", () => {
      this.control[agent] = control.value;
      if (control.value === "keys") {
        this.control[1 - agent] = "mind";
        const other = document.querySelector(`[data-field="control-${1 - agent}"]`);
        if (other) other.value = "mind";
        byId("keys").open = true;
        byId("picture").focus();
      }
    });
    const grid = document.createElement("div");
    grid.className = "grid";
    grid.append(
      labelled("Goal", goal, "wide"), labelled("Attitude", attitude), labelled("Size", size), labelled("Strength", strength),
      labelled("Other's goal", knows),
      labelled("Controlled by", control), ...this.#place(agent),
    );
    const fieldset = document.createElement("fieldset");
    fieldset.className = `agent-${agent}`;
    const legend = document.createElement("legend");
    legend.textContent = `The ${this.names[agent]}`;
    fieldset.append(legend, grid);
    return fieldset;
  }

  #object(k) {
    const spec = this.scene.objects[k];
    const size = this.#field(select(RADII.map((radius, level) => [level, `${radius} u`]), spec.size_level), `size-${k + 2}`, (scene, value) => {
      Object.assign(scene.objects[k], { size_level: Number(value), radius: RADII[value] });
    });
    return [labelled(`Size of the ${this.names[k + 2]}`, size), ...this.#place(k + 2)];
  }
}

/** A helper has the other agent's goal, a hinderer its opposite. */
function settle(scene) {
  const [first, second] = scene.agents;
  for (const [own, other] of [[first, second], [second, first]]) {
    if (own.alpha !== 0 && other.alpha === 0) own.goal = { ...other.goal, sign: own.alpha * other.goal.sign };
  }
  // Helping and hindering are names that have to fit; the right one is known once the rest is.
  scene.event = "independent";
}

function same(a, b) {
  const text = (value) => JSON.stringify(Object.entries(value).sort());
  return text(a) === text(b);
}
