// The pantograph: a pen in a hand that the mouse leads, cranks and rods, a shape that pushes it out.
"use strict";

const LINK_M = 0.1;
const STAGE = { width: 480, height: 430, x: 240, y: 412, per_m: 2000 };
const NEWTON = 110; // length of a force's arrow for 1 N
const HARD = 50, SOFT = 30, SLIPPERY = 0, STICKY = 0.03; // N/m and Ns/m of the study

const to_stage = (x, y) => [STAGE.x + STAGE.per_m * x, STAGE.y - STAGE.per_m * y];
const outline_path = (shape) => path(shape.outline.map(([x, y]) => to_stage(x / 1e5, y / 1e5))) + "Z";

class PenStage {
  /** `moved()` is called when the hand wants to be elsewhere. */
  constructor(core, first, place, moved) {
    this.pen = new core.Pen(first.image);
    this.moved = moved;
    this.shown = []; // [outline, label] that are drawn
    this.arrow = true;
    this.seen = this.pen.state();
    this.lead = [this.seen.x, this.seen.y];
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const point = (event) => { const [x, y] = pointed(event, this.svg); this.aim((x - STAGE.x) / STAGE.per_m, (STAGE.y - y) / STAGE.per_m); };
    const leads = { point, steps, step: ([x, y]) => this.aim(this.lead[0] + x / 1000, this.lead[1] + y / 1000) };
    Object.assign(this, make_stage(place, `0 0 ${STAGE.width} ${STAGE.height}`, "Pantograph: the pen follows the mouse, or the arrow keys by a millimetre", leads));
  }

  /** Another law under the same pen: a shape with a stiffness in N/m and a damping in Ns/m. */
  load(shape, stiffness, damping) {
    say(this.pen.load(shape.image));
    this.loaded = shape;
    this.material(stiffness, damping);
  }

  material(stiffness, damping) {
    say(this.pen.set("stiffness", stiffness));
    say(this.pen.set("damping", damping));
  }

  aim(x, y) {
    this.lead = [Math.max(-0.12, Math.min(0.12, x)), Math.max(0, Math.min(0.2, y))];
    this.moved();
  }

  /** Pen and hand at rest, at once. */
  place(x, y) {
    this.pen.place(x, y);
    this.lead = [x, y];
  }

  advance(seconds) {
    this.pen.lead(...this.lead);
    const said = this.pen.advance(seconds);
    this.seen = this.pen.state();
    return said;
  }

  draw() {
    const s = this.seen, half = Math.acos(Math.min(1, Math.hypot(s.x, s.y) / (2 * LINK_M))), middle = Math.atan2(s.y, s.x);
    const elbow = (angle) => to_stage(LINK_M * Math.cos(angle), LINK_M * Math.sin(angle));
    const motor = to_stage(0, 0), pen = to_stage(s.x, s.y), hand = to_stage(s.hand_x, s.hand_y);
    const under = this.shown.map(([shape, label]) => {
      const [x, y] = middle_of(shape);
      return `<path class="outline" d="${outline_path(shape)}"/>` + (label || []).map((line, n) => `<text class="label" x="${x}" y="${y - 2 + 15 * n}">${line}</text>`).join("");
    }).join("");
    let over = under + [middle - half, middle + half].map((angle) => `<path class="link" d="${path([motor, elbow(angle), pen])}"/>${circle("joint", elbow(angle), 4)}`).join("");
    over += circle("hub", motor, 10) + hand_ring(pen, hand, 11) + circle("knob", pen, 6);
    const newton = Math.hypot(s.force_x, s.force_y);
    const per_newton = Math.min(NEWTON, 150 / newton);
    if (this.arrow && newton > 0) over += arrow(pen, per_newton * s.force_x, -per_newton * s.force_y, "force");
    this.svg.innerHTML = over;
    const mm = (m) => fixed(1000 * m, 1);
    this.caption.textContent = `pen ${mm(s.x)}, ${mm(s.y)} mm: joints at ${s.counts_1} and ${s.counts_5} counts` +
      (this.arrow ? `\nF = ${fixed(newton, 2)} N (${fixed(s.force_x, 2)}, ${fixed(s.force_y, 2)}), the law's words at ${fixed(s.rate_hz / 1000, 1)} kHz` : "");
  }
}

function middle_of(shape) {
  const side = (n) => shape.outline.map((p) => p[n]), middle = (list) => (Math.min(...list) + Math.max(...list)) / 2e5;
  return to_stage(middle(side(0)), middle(side(1)));
}

/** The tab: shapes to try, the training screen, the game. */
class PenTab {
  constructor(core, numbers) {
    this.shapes = numbers.shapes;
    this.stage = new PenStage(core, this.shapes[0], $("pen-stage"), () => this.game && this.game.touched());
    this.game = new Game(this, numbers.shapes.map((shape) => shape.name));
    const labels = [["high stiffness", "low damping"], ["high stiffness", "high damping"], ["low stiffness", "low damping"], ["low stiffness", "high damping"]];
    const materials = [[HARD, SLIPPERY], [HARD, STICKY], [SOFT, SLIPPERY], [SOFT, STICKY]];
    this.squares = numbers.training.map((shape, n) => ({ shape, label: labels[n], material: materials[n] }));
    for (const shape of this.shapes) $("pen-shape").append(option(shape.name, shape.name));
    $("pen-shape").value = "square";
    for (const id of ["pen-shape", "pen-outline"]) $(id).oninput = () => this.choose("try");
    wire_slider("pen-stiffness", (value) => `${fixed(value, 0)} N/m`, () => this.choose("try"));
    wire_slider("pen-damping", (value) => `${fixed(value, 3)} Ns/m`, () => this.choose("try"));
    $("pen-arrow").oninput = () => (this.stage.arrow = $("pen-arrow").checked);
    for (const radio of document.querySelectorAll("#pen-modes input")) radio.onchange = () => this.choose(radio.value);
  }

  named(name) {
    return this.shapes.find((shape) => shape.name === name);
  }

  choose(mode) {
    const entered = this.mode !== mode;
    this.mode = mode;
    for (const id of ["try", "training", "game"]) $(`pen-${id}`).hidden = id !== mode;
    if (entered) this.stage.place(0, 0.06);
    if (mode === "try") {
      const shape = this.named($("pen-shape").value), stiffness = Number($("pen-stiffness").value), damping = Number($("pen-damping").value);
      this.stage.shown = $("pen-outline").checked ? [[shape]] : [];
      if (this.stage.loaded !== shape) this.stage.load(shape, stiffness, damping);
      else this.stage.material(stiffness, damping);
    } else if (mode === "training") {
      this.stage.shown = this.squares.map((s) => [s.shape, s.label]);
      this.near = null;
    } else if (entered) this.game[this.game.shape ? "load" : "next"](); // the round that was left, or the first
  }

  /** The engine holds one shape: in training that of the square that the pen is next to. */
  nearest_square() {
    const place = to_stage(this.stage.seen.x, this.stage.seen.y);
    const far = (s) => { const [x, y] = middle_of(s.shape); return Math.hypot(x - place[0], y - place[1]); };
    const near = this.squares.reduce((a, b) => (far(b) < far(a) ? b : a));
    if (near === this.near) return;
    this.near = near;
    this.stage.load(near.shape, ...near.material);
  }

  frame(passed) {
    if (this.mode === "training") this.nearest_square();
    run_timed(passed, () => say(this.stage.advance(passed)));
    this.stage.draw();
    if (this.mode === "game") this.game.tell_time();
  }
}
