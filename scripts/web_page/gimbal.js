// A body in space behind a handle that turns about three axes: the mouse turns the hand, the body follows and swings on.
"use strict";

const GIMBAL = { width: 640, height: 430, x: 320, y: 215, per_unit: 120, drag: 150, key: Math.PI / 36, most_nm: 0.1, kept: 240 }; // drag: pixels of a radian; kept: frames of the curve
const GIMBAL_VIEW = { right: [0.9397, 0.342, 0], up: [-0.117, 0.3214, 0.9397], out: [0.3214, -0.883, 0.342] }; // from 20 degrees aside and above; z is up, y leads away
const GIMBAL_SIDES = [[0, 1, "x"], [1, 1.5, "y"], [2, 0.7, "z"]]; // axis, half of the body's side, name
const GIMBAL_LAW = [["inertia", " g m²", 1e-3], ["stiffness", " Nm/rad", 1], ["damping", " mNm s/rad", 1e-3]]; // unit of the slider, in SI

/** A vector, turned by a quaternion w, x, y, z. */
function turned_by([w, x, y, z], v) {
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const axis = [x, y, z], t = cross(axis, v).map((part) => 2 * part), u = cross(axis, t);
  return v.map((part, n) => part + w * t[n] + u[n]);
}

class GimbalTab {
  constructor(core, numbers) {
    this.loop = new core.Gimbal(numbers.gimbal.image, numbers.gimbal.body);
    this.seen = this.loop.state();
    this.trace = [];
    this.values = {};
    const steps = { ArrowLeft: [0, -1, 0], ArrowRight: [0, 1, 0], ArrowUp: [-1, 0, 0], ArrowDown: [1, 0, 0], PageUp: [0, 0, 1], PageDown: [0, 0, -1] };
    Object.assign(this, make_stage($("gimbal-stage"), `0 0 ${GIMBAL.width} ${GIMBAL.height}`,
      "Body in space: drag to turn the hand, with Shift about the line of sight; arrow keys by 5 degrees, Page Up and Page Down about the line of sight", {
        dragged: true,
        down: (event) => (this.at = pointed(event, this.svg)),
        point: (event) => this.drag(event),
        steps,
        step: (way) => this.turn(...way.map((n) => n * GIMBAL.key)),
      }));
    for (const [name, unit, si] of GIMBAL_LAW) {
      wire_slider(`gimbal-law-${name}`, (value) => value + unit, (value) => {
        this.values[name] = value * si;
        say(this.loop.set(name, value));
      });
    }
  }

  drag(event) {
    const at = pointed(event, this.svg), [dx, dy] = [at[0] - this.at[0], at[1] - this.at[1]];
    this.at = at;
    if (event.shiftKey) this.turn(0, 0, -dx / GIMBAL.drag);
    else this.turn(dy / GIMBAL.drag, dx / GIMBAL.drag, 0);
  }

  /** About the picture's right, up and the line of sight, rad. */
  turn(right, up, out) {
    const { right: r, up: u, out: o } = GIMBAL_VIEW;
    this.loop.turn(...r.map((part, n) => right * part + up * u[n] + out * o[n]));
  }

  frame(passed) {
    run_timed(passed, () => say(this.loop.advance(passed)));
    this.seen = this.loop.state();
    keep(this.trace, GIMBAL.kept, this.seen.torque.map((nm) => 1000 * nm));
    this.draw();
    const lines = ["x", "y", "z"].map((text, n) => ({ text, colour: ["--blue", "--red", "--green"][n], values: this.trace.map((row) => row[n]) }));
    draw_traces($("gimbal-torque"), "torque on the handle, mNm, the last seconds", lines, GIMBAL.kept, 10);
  }

  seen_at(v) {
    const along = (axis) => axis.reduce((sum, part, n) => sum + part * v[n], 0);
    return [GIMBAL.x + GIMBAL.per_unit * along(GIMBAL_VIEW.right), GIMBAL.y - GIMBAL.per_unit * along(GIMBAL_VIEW.up), along(GIMBAL_VIEW.out)];
  }

  /** A box around the middle: the faces that are seen, each with a kind. */
  box(orientation, size, kind) {
    let text = "";
    for (const [axis, half, name] of GIMBAL_SIDES) {
      for (const sign of [-1, 1]) {
        const [b, c] = [GIMBAL_SIDES[(axis + 1) % 3], GIMBAL_SIDES[(axis + 2) % 3]];
        const corner = (u, v) => {
          const p = [0, 0, 0];
          [p[axis], p[b[0]], p[c[0]]] = [sign * half * size, u * b[1] * size, v * c[1] * size];
          return this.seen_at(turned_by(orientation, p));
        };
        const normal = [0, 0, 0];
        normal[axis] = sign;
        if (this.seen_at(turned_by(orientation, normal))[2] <= 0) continue;
        text += `<path class="${kind} side-${name}" d="${path([corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)].map(([x, y]) => [x, y]))}Z"/>`;
      }
    }
    return text;
  }

  draw() {
    const s = this.seen, newton_m = Math.hypot(...s.torque), middle = this.seen_at([0, 0, 0]);
    const end = this.seen_at(s.torque.map((nm) => (1.5 * nm) / GIMBAL.most_nm));
    const axes = GIMBAL_SIDES.map(([axis, , name]) => {
      const v = [0, 0, 0];
      v[axis] = 1.55;
      const [x, y] = this.seen_at(turned_by(s.handle, v));
      return `<path class="handline" d="${path([[middle[0], middle[1]], [x, y]])}"/><text class="sight" x="${x + 4}" y="${y - 4}">${name}</text>`;
    }).join("");
    const degrees = (180 / Math.PI) * s.twist;
    this.svg.innerHTML = this.box(s.body, 0.62, "solid-body") + this.box(s.handle, 0.95, "handle") + axes +
      arrow([middle[0], middle[1]], end[0] - middle[0], end[1] - middle[1], "force") +
      `<text x="10" y="20">dashed: the handle in the hand; solid: the body behind the spring</text>` +
      [["twist", `${fixed(degrees, 1)}°`], ["torque", `${fixed(1000 * newton_m, 1)} mNm`]].map(
        ([name, text], n) => `<text x="470" y="${380 + 30 * n}">${name}</text><text class="figure" x="630" y="${382 + 30 * n}">${text}</text>`).join("");
    const { inertia, stiffness, damping } = this.values, swing = Math.sqrt(stiffness / inertia);
    this.caption.textContent = `it swings with √(k/J) = ${fixed(swing, 1)} rad/s, damped by b/(2√(kJ)) = ${stiffness ? fixed(damping / (2 * Math.sqrt(stiffness * inertia)), 2) : "∞"}\nthe law's words at ${fixed(s.rate_hz / 1000, 0)} kHz`;
  }
}
