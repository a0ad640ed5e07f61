// From the keys that are pressed to an action.

const PUSHES = {
  "1,0": "up", "-1,0": "down", "0,-1": "left", "0,1": "right",
  "1,-1": "upleft", "1,1": "upright", "-1,-1": "downleft", "-1,1": "downright",
};
const KEYS = new Set(["ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight", "KeyQ", "KeyE", "Space"]);

/** Tells `hold` of every change of action, and `grab` of every grab. */
export class Keys {
  #pressed = new Set();
  #action = "stop";
  #hold;
  #grab;

  constructor({ hold, grab, active, pad }) {
    this.#hold = hold;
    this.#grab = grab;
    addEventListener("keydown", (event) => {
      const typing = event.target instanceof HTMLInputElement || event.target instanceof HTMLButtonElement && event.code === "Space";
      if (!active() || typing || !KEYS.has(event.code) || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      if (!event.repeat) this.#down(event.code);
    });
    addEventListener("keyup", (event) => this.#up(event.code));
    addEventListener("blur", () => this.release());
    for (const button of pad.querySelectorAll("button")) {
      const code = button.dataset.key;
      button.addEventListener("pointerdown", (event) => {
        event.preventDefault();
        button.setPointerCapture(event.pointerId);
        this.#down(code);
      });
      for (const end of ["pointerup", "pointercancel"]) button.addEventListener(end, () => this.#up(code));
      // By keyboard or a screen reader: one press, one step.
      button.addEventListener("click", (event) => {
        if (event.detail !== 0) return;
        this.#down(code);
        this.#up(code);
      });
    }
  }

  /** Nothing is pressed any more. */
  release() {
    this.#pressed.clear();
    this.#changed();
  }

  #down(code) {
    if (code === "Space") this.#grab();
    else this.#pressed.add(code);
    this.#changed();
  }

  #up(code) {
    this.#pressed.delete(code);
    this.#changed();
  }

  #changed() {
    const key = (code) => (this.#pressed.has(code) ? 1 : 0);
    const ahead = key("ArrowUp") - key("ArrowDown");
    const right = key("ArrowRight") - key("ArrowLeft");
    let action = "stop";
    if (ahead || right) action = PUSHES[`${ahead},${right}`];
    else if (key("KeyQ") !== key("KeyE")) action = key("KeyQ") ? "turnleft" : "turnright";
    if (action === this.#action) return;
    this.#action = action;
    this.#hold(action);
  }
}
