// The virtual objects: what a user may turn, the law with its live numbers, and how each is drawn.
"use strict";

const SCENES = {
  free: { title: "free", sliders: [], law: () => "τ = 0" },
  setpoint: {
    title: "constant torque",
    sliders: [{ name: "setpoint_torque", label: "torque", unit: "Nm", low: -0.4, high: 0.4, value: 0.07 }],
    law: (v, s) => (s.held ? `τ = τ₀ = ${fixed(v.setpoint_torque)} Nm` : `τ = 0: nobody holds the lever
τ₀ = ${fixed(v.setpoint_torque)} Nm would only make it faster`),
  },
  membrane: {
    title: "membrane",
    sliders: [{ name: "membrane_torque", label: "torque", unit: "Nm", low: 0, high: 0.5, value: 0.07 }],
    law: (v, s) => `τ = ∓τₘ between the faces ${fixed(v.lower)} and ${fixed(v.upper)} rad\nτₘ = ${fixed(v.membrane_torque)} Nm, θ = ${fixed(s.theta)} rad`,
  },
  spring_compression: {
    title: "spring, pressed",
    sliders: [{ name: "compression_stiffness", label: "stiffness", unit: "Nm/rad", per_count: true, low: 0, high: 1.9, value: 0.3 }],
    law: (v, s) => `τ = K (θc − θ) below θc\n  = ${fixed(v.compression_stiffness)} · (${fixed(v.contact)} − ${fixed(s.theta)})`,
  },
  spring_tension: {
    title: "spring, stretched",
    sliders: [{ name: "tension_stiffness", label: "stiffness", unit: "Nm/rad", per_count: true, low: 0, high: 1.9, value: 0.15 }],
    law: (v, s) => `τ = −K (θ − θ₀)\n  = −${fixed(v.tension_stiffness)} · (${fixed(s.theta)} − ${fixed(v.rest)})`,
  },
  damper: {
    title: "damper",
    sliders: [{ name: "damper_damping", label: "damping", unit: "Nm s/rad", low: 0, high: 0.05, value: 0.03 }],
    law: (v, s) => `τ = −B ω\n  = −${fixed(v.damper_damping)} · ${fixed(s.omega, 2)} rad/s`,
  },
  charge_attract: {
    title: "charge, attracts",
    sliders: [{ name: "attract_strength", label: "strength", unit: "Nm rad²", per_count2: true, slope: "attract_core_slope", low: 0, high: 0.04, value: 0.003 }],
    law: (v, s) => `τ = −C d/|d|³, linear within ${fixed(v.core)} rad\n  C = ${fixed(v.attract_strength, 4)} Nm rad², d = ${fixed(s.theta - v.centre)} rad`,
  },
  charge_repel: {
    title: "charge, repels",
    sliders: [{ name: "repel_strength", label: "strength", unit: "Nm rad²", per_count2: true, slope: "repel_core_slope", low: 0, high: 0.04, value: 0.003 }],
    law: (v, s) => `τ = C d/|d|³, linear within ${fixed(v.core)} rad\n  C = ${fixed(v.repel_strength, 4)} Nm rad², d = ${fixed(s.theta - v.centre)} rad`,
  },
  wall: {
    title: "wall",
    sliders: [
      { name: "wall_stiffness", label: "stiffness", unit: "Nm/rad", per_count: true, low: 0.5, high: 60, value: 4, log: true },
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

/** SVG of the object around a lever at theta; it bends and moves as the lever acts on it. */
function drawing(scene, g, s) {
  const shape = (kind, d) => `<path class="${kind}" d="${d}"/>`;
  if (scene === "wall") {
    const face = Math.max(g.contact, s.theta);
    return shape("solid", sector(face, g.contact + 0.9, 60, 225)) + shape("object", path([...arc(g.contact, face, 60), at(face, 62), at(face, 225)]));
  }
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
