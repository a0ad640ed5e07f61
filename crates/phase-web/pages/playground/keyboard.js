// From the keys that are pressed to an action.

const PUSHES = {
  "1,0": "up", "-1,0": "down", "0,-1": "left", "0,1": "right",
  "1,-1": "upleft", "1,1": "upright", "-1,-1": "downleft", "-1,1": "downright",
};

/** Watches the keys that go to an element. */
export class Keyboard {
  #pressed = new Set();
  #grab = false;

  constructor(element) {
    const ours = new Set(["ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight", "KeyQ", "KeyE", "Space"]);
    element.addEventListener("keydown", (event) => {
      if (!ours.has(event.code) || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      this.#pressed.add(event.code);
      if (event.code === "Space" && !event.repeat) this.#grab = true;
    });
    element.addEventListener("keyup", (event) => this.#pressed.delete(event.code));
    element.addEventListener("blur", () => this.#pressed.clear());
  }

  /** The name of the action for the next step; `holds` says whether the agent holds an object. */
  action(holds) {
    if (this.#grab) {
      this.#grab = false;
      return holds ? "detach" : "attach";
    }
    const key = (code) => (this.#pressed.has(code) ? 1 : 0);
    const ahead = key("ArrowUp") - key("ArrowDown");
    const right = key("ArrowRight") - key("ArrowLeft");
    if (ahead || right) return PUSHES[`${ahead},${right}`];
    if (key("KeyQ") !== key("KeyE")) return key("KeyQ") ? "turnleft" : "turnright";
    return "stop";
  }
}
