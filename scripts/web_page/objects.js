// The virtual objects: what a user may turn, the law with its live numbers, and how each is drawn.
"use strict";

const SCENES = {
  free: { title: "free", begin: "Take the ball and swing the lever: the motor does nothing, you feel bearing and gears.", sliders: [], law: () => "τ = 0" },
  setpoint: {
    title: "constant torque",
    begin: "Take the ball and hold it: the motor pushes with the same force everywhere.",
    sliders: [{ name: "setpoint_torque", label: "torque", unit: "Nm", low: -0.4, high: 0.4, value: 0.07 }],
    law: (v, s) => (s.held ? `τ = τ₀ = ${fixed(v.setpoint_torque)} Nm` : `τ = 0: nobody holds the lever
τ₀ = ${fixed(v.setpoint_torque)} Nm would only make it faster`),
  },
  membrane: {
    title: "membrane",
    begin: "Take the ball and press it through the membrane.",
    sliders: [{ name: "membrane_torque", label: "torque", unit: "Nm", low: 0, high: 0.5, value: 0.07 }],
    law: (v, s) => `τ = ∓τₘ between the faces ${fixed(v.lower)} and ${fixed(v.upper)} rad\nτₘ = ${fixed(v.membrane_torque)} Nm, θ = ${fixed(s.theta)} rad`,
  },
  spring_compression: {
    title: "spring, pressed",
    begin: "Take the ball and press it to the left, into the spring.",
    sliders: [{ name: "compression_stiffness", label: "stiffness", unit: "Nm/rad", per_count: true, low: 0, high: 1.9, value: 0.3 }],
    law: (v, s) => `τ = K (θc − θ) below θc\n  = ${fixed(v.compression_stiffness)} · (${fixed(v.contact)} − ${fixed(s.theta)})`,
  },
  spring_tension: {
    title: "spring, stretched",
    begin: "Take the ball and pull at the spring.",
    sliders: [{ name: "tension_stiffness", label: "stiffness", unit: "Nm/rad", per_count: true, low: 0, high: 1.9, value: 0.15 }],
    law: (v, s) => `τ = −K (θ − θ₀)\n  = −${fixed(v.tension_stiffness)} · (${fixed(s.theta)} − ${fixed(v.rest)})`,
  },
  damper: {
    title: "damper",
    begin: "Take the ball and stir quickly: it is like oil.",
    sliders: [{ name: "damper_damping", label: "damping", unit: "Nm s/rad", low: 0, high: 0.05, value: 0.03 }],
    law: (v, s) => `τ = −B ω\n  = −${fixed(v.damper_damping)} · ${fixed(s.omega, 2)} rad/s`,
  },
  charge_attract: {
    title: "charge, attracts",
    begin: "Take the ball past the charge: it is pulled in.",
    sliders: [{ name: "attract_strength", label: "strength", unit: "Nm rad²", per_count2: true, slope: "attract_core_slope", low: 0, high: 0.04, value: 0.003 }],
    law: (v, s) => `τ = −C d/|d|³, linear within ${fixed(v.core)} rad\n  C = ${fixed(v.attract_strength, 4)} Nm rad², d = ${fixed(s.theta - v.centre)} rad`,
  },
  charge_repel: {
    title: "charge, repels",
    begin: "Take the ball past the charge: it is pushed away.",
    sliders: [{ name: "repel_strength", label: "strength", unit: "Nm rad²", per_count2: true, slope: "repel_core_slope", low: 0, high: 0.04, value: 0.003 }],
    law: (v, s) => `τ = C d/|d|³, linear within ${fixed(v.core)} rad\n  C = ${fixed(v.repel_strength, 4)} Nm rad², d = ${fixed(s.theta - v.centre)} rad`,
  },
  wall: {
    title: "wall",
    begin: "Take the ball and press it into the bricks.",
    sliders: [
      { name: "wall_stiffness", label: "stiffness", unit: "Nm/rad", per_count: true, low: 0.5, high: 60, value: 4, log: true, border: true },
      { name: "wall_damping", label: "damping", unit: "Nm s/rad", low: 0, high: 0.05, value: 0.005 },
      { name: "rate", label: "rate", choices: [["in the core, 1 MHz", 1], ["host, 10 kHz", 100], ["host, 1 kHz", 1000], ["host, 490 Hz", 2040], ["host, 144 Hz", 6940]] },
    ],
    law: (v, s) => `τ = −K (θ − θw) − B ω above θw\n  = −${fixed(v.wall_stiffness, 2)} · ${fixed(Math.max(0, s.theta - v.contact))} − ${fixed(v.wall_damping, 4)} · ${fixed(s.omega, 2)}`,
  },
};

// What a fault says to someone who plays; docs/safety.md has the rest.
const FAULTS = {
  encoder: "illegal steps at the encoder, or it fails",
  speed: "faster than the design allows",
  polarity: "the lever runs away from the torque: wires are swapped",
  i2t: "too much current for too long: the motor would get too hot",
  watchdog: "the host is silent",
  stop: "the stop is pressed, or was",
  channel: "one channel of the encoder is dead",
  jump: "the velocity jumped",
  self_test: "the lever did not answer the first pulse as it should",
  tick: "the clock of the ticks stands still",
  index: "the count at the index is wrong",
  word: "a word changed by itself",
  engine: "the program's torque came too late",
  axis: "another axis has a fault",
  current: "too much current, or the current is not measured",
};

const fixed = (x, digits = 3) => (x === undefined ? "?" : x.toFixed(digits).replace("-", "−"));

// What the pictures need of a design's parameters, in rad and Nm.
function geometry(scene, words, count_rad) {
  const rad = (name) => words[name] * count_rad;
  if (scene === "membrane") return { lower: rad("membrane_lower"), upper: rad("membrane_upper") };
  if (scene === "spring_compression") return { contact: rad("compression_contact") };
  if (scene === "spring_tension") return { rest: rad("tension_rest") };
  if (scene === "charge_attract") return { centre: rad("attract_centre"), core: rad("attract_core") };
  if (scene === "charge_repel") return { centre: rad("repel_centre"), core: rad("repel_core") };
  if (scene === "wall") return { contact: rad("wall_contact") };
  return {};
}

const CENTRE = [250, 320], LENGTH = 235;
const at = (theta, r) => [CENTRE[0] + r * Math.sin(theta), CENTRE[1] - r * Math.cos(theta)];
const path = (points) => "M" + points.map((p) => p.map((x) => x.toFixed(1)).join(" ")).join("L");
const ray = (theta, inner, outer) => path([at(theta, inner), at(theta, outer)]);
function arc(from, to, r) {
  const n = Math.max(2, Math.ceil(Math.abs(to - from) / 0.03));
  return Array.from({ length: n + 1 }, (_, i) => at(from + ((to - from) * i) / n, r));
}
function coil(from, to, r, turns) {
  const n = turns * 12;
  return path(Array.from({ length: n + 1 }, (_, i) => at(from + ((to - from) * i) / n, r + 14 * Math.sin((i / 12) * 2 * Math.PI))));
}
const sector = (from, to, inner, outer) => path([...arc(from, to, inner), ...arc(to, from, outer)]) + "Z";

const degrees = (rad) => ((rad * 180) / Math.PI).toFixed(2);
const BAR = 8; // half of its width
const circle = (kind, [x, y], r) => `<circle class="${kind}" cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="${r}"/>`;

/** A wall whose face the bar meets at `contact`; what is pressed in glows. */
function brick_wall(contact, theta) {
  const [x, y] = [CENTRE[0] + BAR, CENTRE[1] - 205], pressed = Math.max(contact, theta);
  const box = (kind, wide) => `<rect class="${kind}" x="${x}" y="${y}" width="${wide}" height="140"/>`;
  return `<g transform="rotate(${degrees(contact)} ${CENTRE})"><rect class="shadow" x="${x + 6}" y="${y + 8}" width="128" height="140"/>${box("bricks", 128)}${box("mortar", 128)}</g>
    <path class="pressed" d="${sector(contact, pressed, 65, 205)}"/>`;
}

/** A motor seen along its shaft, and the bar with a ball that sits on it. */
function motor_and_bar(theta) {
  const [x, y] = CENTRE, ball = at(theta, LENGTH), bar = ray(theta, -24, LENGTH - 8);
  const screws = [0.8, 2.35, 3.95, 5.5].map((a) => circle("screw", [x + 47 * Math.cos(a), y + 47 * Math.sin(a)], 4.5));
  return `<path class="cable" d="M${x} ${y + 50}q4 30 40 34t60 46"/>${circle("shadow", [x + 4, y + 7], 60)}${circle("can", [x, y], 60)}${circle("flange", [x, y], 40)}${screws.join("")}<text class="engraved" x="${x}" y="${y + 54}">motor</text>
    <path class="edge" d="${bar}"/><path class="lever" d="${bar}"/>${circle("hub", [x, y], 17)}${circle("screw", [x, y], 7)}${circle("knob", ball, 19)}${circle("gloss", ball, 19)}`;
}

/** A hand around the ball of a lever at theta, leaning to where it wants to be. */
function hand_at(theta, lean) {
  const [x, y] = at(theta, LENGTH), tilt = Math.max(-14, Math.min(14, 40 * lean));
  const finger = "M-21 3C-33 -22 -30 -56 -6 -84", thumb = "M21 5C33 -20 30 -48 14 -80", palm = "M6 -92L22 -150", sleeve = "M24 -158L46 -240";
  const part = (kind, d) => `<path class="skin edge ${kind}" d="${d}"/>`, over = (kind, d) => `<path class="skin ${kind}" d="${d}"/>`;
  return `<g class="hand" transform="translate(${x.toFixed(1)} ${y.toFixed(1)}) rotate(${(Number(degrees(theta)) + tilt).toFixed(2)})">
    ${part("sleeve", sleeve)}${over("sleeve", sleeve)}${part("palm", palm)}${part("finger", finger)}${part("finger", thumb)}${over("palm", palm)}${over("finger", finger)}${over("finger", thumb)}
    <ellipse class="nail" cx="-24" cy="-3" rx="3.5" ry="6" transform="rotate(-12 -24 -3)"/><ellipse class="nail" cx="24" cy="-1" rx="3.5" ry="6" transform="rotate(12 24 -1)"/></g>`;
}

/** SVG of the object around a lever at theta; it bends and moves as the lever acts on it. */
function drawing(scene, g, s) {
  const shape = (kind, d) => `<path class="${kind}" d="${d}"/>`;
  if (scene === "wall") return brick_wall(g.contact, s.theta);
  if (scene === "membrane") {
    const inside = s.theta > g.lower && s.theta < g.upper;
    const bulge = (face) => {
      const lean = inside ? Math.sign(s.tau || 0) : 0;
      return path(Array.from({ length: 25 }, (_, i) => {
        const r = 60 + (i / 24) * 165, bend = Math.sin((i / 24) * Math.PI);
        return at(face + (inside ? (s.theta - face) * bend * 0.8 * (lean !== 0 ? 1 : 0.5) : 0), r);
      }));
    };
    return shape("solid", sector(g.lower, g.upper, 60, 225)) + shape("object", bulge(g.lower)) + shape("object", bulge(g.upper));
  }
  if (scene === "spring_compression") {
    const end = Math.min(g.contact, s.theta), foot = g.contact - 1.4;
    return shape("object", coil(foot, Math.max(end, foot + 0.15), 130, 9)) + shape("object", ray(foot, 100, 160)) + shape("scale", ray(g.contact, 60, 225));
  }
  if (scene === "spring_tension") return shape("object", coil(g.rest, s.theta, 130, 9)) + shape("object", ray(g.rest, 100, 160));
  if (scene === "damper") {
    const wake = Array.from({ length: 6 }, (_, i) => shape("field", path(arc(s.theta - Math.sign(s.omega) * 0.05, s.theta - s.omega * 0.05, 90 + 22 * i))));
    return Math.abs(s.omega) > 0.05 ? wake.join("") : "";
  }
  if (scene.startsWith("charge")) {
    const [x, y] = at(g.centre, LENGTH + 40), [hx, hy] = at(s.theta, LENGTH);
    const lines = Array.from({ length: 16 }, (_, i) => {
      const a = (i / 16) * 2 * Math.PI;
      let p = [x + 16 * Math.cos(a), y + 16 * Math.sin(a)];
      const points = [p];
      for (let n = 0; n < 26; ++n) { // along the field of two charges
        const e = (cx, cy, q) => { const dx = p[0] - cx, dy = p[1] - cy, r = Math.hypot(dx, dy) + 1; return [(q * dx) / r ** 3, (q * dy) / r ** 3]; };
        const f = e(x, y, 1), h = e(hx, hy, scene === "charge_repel" ? 1 : -1), sum = [f[0] + h[0], f[1] + h[1]], size = Math.hypot(...sum);
        p = [p[0] + (7 * sum[0]) / size, p[1] + (7 * sum[1]) / size];
        points.push(p);
        if (Math.hypot(p[0] - hx, p[1] - hy) < 9) break;
      }
      return shape("field", path(points));
    });
    const sign = scene === "charge_repel" ? "+" : "−";
    return lines.join("") + `<circle class="knob" cx="${x}" cy="${y}" r="15"/><text class="sign" x="${x - 6}" y="${y + 7}">+</text>` +
      `<circle class="knob" cx="${hx}" cy="${hy}" r="13"/><text class="sign" x="${hx - 6}" y="${hy + 7}">${sign}</text>`;
  }
  if (scene === "setpoint") return shape("object", path(arc(-0.25, 0.25, 60)));
  return "";
}
