// A knob with detents on a motor of three phases: the mouse turns it, the electrical angle and the legs are seen.
"use strict";

const KNOB = { middle: 200, marks: 172, ring: 146, cap: 104, radius_m: 0.02 };
const KNOB_DIAL = { x: 150, y: 108, radius: 84, most: 0.3 }; // most: of the amplitude, the longest arrow
const KNOB_KEPT = 1000; // samples of the curves: 1 s
const KNOB_LEGS = [["A", "one", "--blue"], ["B", "two", "--green"], ["C", "three", "--object"]];
const TURN = 2 * Math.PI;

/** Clockwise from above, as the lever is drawn. */
const round_at = (x, y, radius, rad) => [x + radius * Math.sin(rad), y - radius * Math.cos(rad)];
const wrapped = (rad) => rad - TURN * Math.round(rad / TURN);
const turned_degrees = (turns) => 360 * (turns - Math.floor(turns));

class KnobTab {
  constructor(core) {
    this.knob = new core.Knob();
    this.most = core.KNOB_MOST_RAD;
    this.seen = this.knob.state();
    this.lead = 0;
    this.held = false;
    this.trace = [];
    $("knob-stage").innerHTML = `<div id="knob-pair"><svg id="knob-face" viewBox="0 0 400 400" tabindex="0" role="slider" aria-valuenow="0"
      aria-label="Knob: the hand's angle in rad; arrow keys turn it, the space bar holds and lets go"></svg>
      <svg id="knob-dial" viewBox="0 0 300 400" role="img" aria-label="Electrical angle, and on-times, voltages and currents of the three legs"></svg></div>
      <figcaption><span class="equation"></span></figcaption>`;
    this.svg = $("knob-face");
    this.caption = $("knob-stage").querySelector(".equation");
    const point = (event) => {
      const [x, y] = pointed(event, this.svg), at = Math.atan2(x - KNOB.middle, KNOB.middle - y);
      this.aim(this.lead + wrapped(at - (event.type === "pointerdown" ? at : this.at)));
      this.at = at;
    };
    led_by(this.svg, taken(this, { ArrowLeft: -0.05, ArrowRight: 0.05, ArrowDown: -0.2, ArrowUp: 0.2 }, point));
    $("knob-pitch").oninput = () => this.detents();
    $("knob-offset").oninput = () => this.misalign();
    $("knob-armed").oninput = () => this.knob.arm($("knob-armed").checked);
    wire_slider("knob-peak", (mnm) => `${fixed(mnm, 1)} mNm`, () => this.detents());
    this.misalign();
  }

  take(held) {
    if (held === this.held) return;
    this.held = held;
    this.lead = this.seen.theta;
    this.knob.hold(held);
    this.svg.classList.toggle("held", held);
  }

  aim(rad) {
    this.lead = Math.max(-this.most, Math.min(this.most, rad));
    this.knob.lead(this.lead);
  }

  detents() {
    this.pitch = Number($("knob-pitch").value);
    say(this.knob.detents(this.pitch, Number($("knob-peak").value) / 1000));
  }

  /** The motor stays as it is; the core's word is wrong. */
  misalign() {
    const wrong = Number($("knob-offset").value);
    say(this.knob.offset(wrong / 360));
    $("knob-said").className = wrong ? "shakes" : "";
    $("knob-said").textContent = {
      0: "The voltage turns with the rotor: the motor gives the torque that is asked for.",
      60: "The motor gives half of the torque that is asked for, for the same current. Nothing notices.",
      90: "The current only warms the motor: the knob has no detents.",
      180: "Every detent pushes the knob away, and it trembles on a crest. A motor that moves by itself can hurt.",
    }[wrong] + (wrong >= 90 ? " A core with its self-test, which this tab leaves out, does not arm with an offset that is wrong by 90° to 270°." : "");
  }

  frame(passed) {
    run_timed(passed, () => say(this.knob.advance(passed)));
    this.seen = this.knob.state();
    const samples = this.knob.samples();
    for (let n = 0; n < samples.length; n += 5) keep(this.trace, KNOB_KEPT, samples.slice(n, n + 5));
    this.draw_face();
    this.draw_dial();
    this.draw_curves();
  }

  draw_face() {
    const { theta, hand, detent, torque } = this.seen, c = KNOB.middle, at = (radius, rad) => round_at(c, c, radius, rad);
    const line = (kind, from, to, rad) => `<path class="${kind}" d="${path([at(from, rad), at(to, rad)])}"/>`;
    let marks = "";
    for (let k = Math.ceil((theta - Math.PI) / this.pitch); k * this.pitch < theta + Math.PI; ++k) {
      const rad = k * this.pitch;
      marks += line(Math.abs(rad - detent) < 0.01 ? "detent here" : "detent", KNOB.marks - 10, KNOB.marks + 8, rad);
    }
    const grips = Array.from({ length: 24 }, (_, n) => line("grip", KNOB.ring - 12, KNOB.ring - 2, theta + (n * TURN) / 24)).join("");
    const newton = torque / KNOB.radius_m, tip = at(KNOB.ring, theta), reach = Math.max(-90, Math.min(90, 110 * newton));
    const held = this.held ? hand_ring(tip, at(KNOB.ring, hand), 14) : "";
    this.svg.innerHTML = `${marks}<circle class="shadow" cx="${c + 5}" cy="${c + 8}" r="${KNOB.ring}"/><circle class="ring" cx="${c}" cy="${c}" r="${KNOB.ring}"/>${grips}
      <circle class="cap" cx="${c}" cy="${c}" r="${KNOB.cap}"/>${line("notch", 62, KNOB.cap - 10, theta)}${held}${arrow(tip, reach * Math.cos(theta), reach * Math.sin(theta), "force")}
      <text class="newton" text-anchor="middle" x="${c}" y="${c + 12}">${fixed(Math.abs(newton), 2)} N</text><text class="engraved" x="${c}" y="${c + 32}">at the rim</text>`;
    this.svg.setAttribute("aria-valuenow", (this.held ? hand : theta).toFixed(2));
  }

  draw_dial() {
    const s = this.seen, { x, y, radius, most } = KNOB_DIAL, middle = s.on.reduce((sum, on) => sum + on, 0) / 3;
    const volts = s.on.map((on) => (on - middle) * s.bus), towards = (rad, length) => [length * Math.sin(rad), -length * Math.cos(rad)];
    const sum = volts.reduce(([u, v], volt, n) => { const [a, b] = towards((n * TURN) / 3, volt); return [u + a / 1.5, v + b / 1.5]; }, [0, 0]);
    const per_volt = radius / ((most * s.bus) / Math.sqrt(3)), long = Math.hypot(...sum) * per_volt, shrink = per_volt * Math.min(1, radius / (long || 1));
    const coils = KNOB_LEGS.map(([name], n) => {
      const from = round_at(x, y, radius + 3, (n * TURN) / 3), to = round_at(x, y, radius - 9, (n * TURN) / 3), label = round_at(x, y, radius + 16, (n * TURN) / 3);
      return `<path class="coil" d="${path([from, to])}"/><text text-anchor="middle" x="${label[0]}" y="${label[1] + 4}">${name}</text>`;
    }).join("");
    const off = wrapped(TURN * (s.electrical - s.rotor)), believed = Math.abs(off) > 0.1 ? arrow([x, y], ...towards(TURN * s.electrical, radius - 14), "believed") : "";
    const bars = KNOB_LEGS.map(([name, kind], n) => {
      const top = 270 + 40 * n;
      return `<rect class="scale" x="34" y="${top}" width="256" height="16"/><rect class="leg ${kind}" x="34" y="${top}" width="${256 * s.on[n]}" height="16"/><path class="ink" d="M162 ${top}v20"/>
        <text class="label" x="16" y="${top + 13}">${name}</text><text x="34" y="${top - 5}">on ${fixed(100 * s.on[n], 1)} % · ${fixed(volts[n], 2)} V · ${fixed(s.current[n], 3)} A</text>`;
    }).join("");
    const key = [["rotor", "rotor"], ["vector", `voltage, ${fixed(Math.hypot(...sum), 2)} V`], ...(believed ? [["believed", "rotor, as the core has it"]] : [])];
    const keys = key.map(([kind, text], n) => `<path class="${kind}" d="${path([[8 + (n === 1 ? 90 : 0), 222 + (n === 2 ? 18 : 0)], [28 + (n === 1 ? 90 : 0), 222 + (n === 2 ? 18 : 0)]])}"/><text x="${34 + (n === 1 ? 90 : 0)}" y="${226 + (n === 2 ? 18 : 0)}">${text}</text>`).join("");
    $("knob-dial").innerHTML = `<circle class="scale" cx="${x}" cy="${y}" r="${radius}"/>${coils}${believed}${arrow([x, y], ...towards(TURN * s.rotor, radius - 14), "rotor")}${s.gates ? arrow([x, y], shrink * sum[0], shrink * sum[1], "vector") : ""}
      <text x="6" y="16">electrical</text><text class="figure" x="294" y="18">${fixed(turned_degrees(s.electrical), 0)}°</text>${keys}${bars}${s.gates ? "" : `<text class="off" x="${x}" y="${y + 40}">motor off</text>`}`;
    const offset = fixed(wrapped(TURN * s.offset) * (360 / TURN), 0);
    this.caption.textContent = `e = pole pairs · θ + offset = ${s.pole_pairs} · ${fixed((360 / TURN) * s.theta, 1)}° + ${offset}°, modulo a turn ${fixed(turned_degrees(s.electrical), 0)}°\n` +
      `asked ${fixed(1000 * s.asked, 2)} mNm, motor ${fixed(1000 * s.torque, 2)} mNm: amplitude ${fixed(s.amplitude, 0)} of 1000 clocks`;
  }

  draw_curves() {
    const lines = KNOB_LEGS.map(([name, , colour], n) => ({ text: `leg ${name}`, colour, values: this.trace.map((row) => 100 * (row[n] - 0.5)) }));
    draw_traces($("knob-legs"), "on-times less half a period, %", lines, KNOB_KEPT, 5);
    const torques = [["asked", "--ink", 3], ["motor", "--blue", 4]].map(([text, colour, n]) => ({ text, colour, values: this.trace.map((row) => 1000 * row[n]) }));
    draw_traces($("knob-torque"), "torque, mNm, the last second", torques, KNOB_KEPT, 2);
  }
}
