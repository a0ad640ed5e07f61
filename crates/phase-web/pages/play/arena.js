// Draws what is seen, as the renderer of the videos does.

const MIN = [6, 2];
const SIDE = 20;
const MARGIN = 10; // pixels
const LANDMARK = 5; // side (u)
const WALL = 0.25; // thickness (u)
const OUTLINE = "#282828";
const UNSEEN = "rgb(110 110 120 / 45%)";

/** The cells of 100 hexadecimal digits: for each of the 400 cells whether it is seen. */
export function cells(digits) {
  return Array.from({ length: 400 }, (_, k) => ((Number.parseInt(digits[k >> 2], 16) >> (k & 3)) & 1) === 1);
}

export class Arena {
  #context;
  #scale;
  #size;

  constructor(canvas) {
    this.#context = canvas.getContext("2d");
    this.#size = canvas.width;
    this.#scale = (canvas.width - 2 * MARGIN) / SIDE;
  }

  #x(x) { return MARGIN + (x - MIN[0]) * this.#scale; }
  #y(y) { return this.#size - MARGIN - (y - MIN[1]) * this.#scale; }

  /** `bodies`: `[x, y, angle]` or null, agents first; `grips` and `seen` as in the message `sight`. */
  draw(stage, bodies, grips, seen) {
    const c = this.#context;
    c.fillStyle = "#fff";
    c.fillRect(0, 0, this.#size, this.#size);
    stage.landmarks.forEach(([x, y], k) => {
      c.fillStyle = stage.colours.landmarks[k];
      const side = LANDMARK * this.#scale;
      c.fillRect(this.#x(x) - side / 2, this.#y(y) - side / 2, side, side);
    });
    if (seen) {
      c.fillStyle = UNSEEN;
      const side = this.#scale;
      seen.forEach((visible, k) => {
        if (!visible) c.fillRect(this.#x(MIN[0] + (k % SIDE)), this.#y(MIN[1] + Math.floor(k / SIDE) + 1), side, side);
      });
    }
    c.strokeStyle = "#000";
    c.lineWidth = WALL * this.#scale;
    c.lineCap = "butt";
    for (const [a, b] of stage.walls) {
      c.beginPath();
      c.moveTo(this.#x(a[0]), this.#y(a[1]));
      c.lineTo(this.#x(b[0]), this.#y(b[1]));
      c.stroke();
    }
    c.lineWidth = 3;
    c.strokeRect(MARGIN, MARGIN, SIDE * this.#scale, SIDE * this.#scale);
    bodies.forEach((body, k) => {
      if (!body) return;
      if (k < 2) this.#agent(body, stage.radii[k], stage.colours.agents[k]);
      else this.#disc(body, stage.radii[k], stage.colours.objects[k - 2], OUTLINE);
    });
    grips.forEach((grip, k) => {
      if (grip && bodies[k]) this.#grip(bodies[k], stage.radii[k], stage.colours.agents[k], grip);
    });
  }

  #place([x, y, angle], radius) {
    const [sin, cos] = [Math.sin(angle), Math.cos(angle)];
    return ([right, ahead]) => [this.#x(x + radius * (right * cos - ahead * sin)), this.#y(y + radius * (right * sin + ahead * cos))];
  }

  #polygon(points, fill, stroke) {
    const c = this.#context;
    c.beginPath();
    points.forEach(([x, y], k) => (k ? c.lineTo(x, y) : c.moveTo(x, y)));
    c.closePath();
    this.#paint(fill, stroke);
  }

  #paint(fill, stroke) {
    const c = this.#context;
    c.fillStyle = fill;
    c.fill();
    if (stroke) {
      c.strokeStyle = stroke;
      c.lineWidth = 2.5;
      c.stroke();
    }
  }

  #circle([x, y], radius, fill, stroke) {
    const c = this.#context;
    c.beginPath();
    c.arc(x, y, radius * this.#scale, 0, 2 * Math.PI);
    this.#paint(fill, stroke);
  }

  #disc([x, y], radius, fill, stroke) {
    this.#circle([this.#x(x), this.#y(y)], radius - 0.04, fill, stroke);
  }

  #agent(body, radius, colour) {
    const place = this.#place(body, radius);
    this.#polygon([[-1.5, -1], [1.5, -1], [0.5, 1], [-0.5, 1]].map(place), colour, OUTLINE);
    for (const side of [-1, 1]) {
      this.#circle(place([0.5 * side, 0.5]), 0.335 * radius, "#000");
      this.#circle(place([0.5 * side, 0.5]), 0.291 * radius, "#fff");
      this.#circle(place([0.5 * side, 0.7]), 0.224 * radius, "#000");
    }
  }

  #grip(body, radius, colour, { side: [x, y] }) {
    const place = this.#place(body, radius);
    const bar = (length, depth) => [[-length, -depth], [length, -depth], [length, depth], [-length, depth]]
      .map(([across, deep]) => place([x * (1 + deep) - y * across, y * (1 + deep) + x * across]));
    this.#polygon(bar(0.48, 0.16), colour);
    this.#polygon(bar(0.4, 0.09), OUTLINE);
  }
}
