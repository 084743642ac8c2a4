// Two levers that only a law couples: either can be dragged, the second one meets something.
"use strict";

const MET = {
  nothing: { number: 0, strength: 0, low: 0, high: 0, unit: "" },
  spring: { number: 1, strength: 1, low: 0.1, high: 4, unit: "Nm/rad" },
  wall: { number: 2, strength: 6, low: 1, high: 20, unit: "Nm/rad" },
  weight: { number: 3, strength: 0.2, low: 0, high: 0.4, unit: "Nm" },
};
const COUPLING = [
  { name: "stiffness", label: "stiffness", unit: "Nm/rad", low: 0.5, high: 8, step: 0.1, value: 4 },
  { name: "damping", label: "damping", unit: "Nm s/rad", low: 0, high: 0.03, step: 0.001, value: 0.01 },
  { name: "share", label: "observer", unit: "", low: 0, high: 1, step: 0.05, value: 0 },
  { name: "calm", label: "calm", unit: "Nm s/rad", low: 0, high: 0.03, step: 0.001, value: 0.01 },
];
const MOST_SHARE = 0.5; // with a hand on the second lever: beyond, nothing holds the first one, and it swings
const COUPLED_TRACE = 240; // frames that the curve keeps

class CoupledLever {
  constructor(tab, place, number) {
    this.tab = tab;
    this.number = number;
    this.figure = document.createElement("figure");
    this.figure.innerHTML = `<svg viewBox="0 0 500 400" tabindex="0" role="slider" aria-label="${number ? "Second" : "First"} lever: the hand's angle in rad" aria-valuemin="${-tab.most}" aria-valuemax="${tab.most}" aria-valuenow="0"></svg>
      <figcaption><span class="name">${number ? "second lever" : "first lever"}</span><div class="equation"></div></figcaption>`;
    this.svg = this.figure.querySelector("svg");
    place.append(this.figure);
    this.svg.addEventListener("pointerdown", (event) => { this.svg.setPointerCapture(event.pointerId); this.point(event); });
    this.svg.addEventListener("pointermove", (event) => { if (event.buttons) this.point(event); });
    this.svg.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: -0.02, ArrowRight: 0.02 }[event.key];
      if (!step) return;
      event.preventDefault();
      tab.hold(number);
      tab.aim(tab.lead + step);
    });
  }

  point(event) {
    const [x, y] = pointed(event, this.svg);
    this.tab.hold(this.number);
    this.tab.aim(Math.atan2(x - CENTRE[0], Math.max(CENTRE[1] - y, 1)));
  }

  /** What the second lever meets. */
  met(theta) {
    const { met, wall } = this.tab;
    if (met === "spring") return `<path class="object" d="${coil(-1.2, theta, 130, 9)}"/><path class="object" d="${ray(-1.2, 100, 160)}"/>`;
    if (met === "wall") return `<path class="solid" d="${sector(Math.max(wall, theta), 1.2, 60, 225)}"/><path class="object" d="${ray(wall, 60, 225)}"/>`;
    if (met !== "weight") return "";
    const [x, y] = at(theta, 150);
    return `<path class="object" d="${path([[x, y], [x - 60, y]])}"/><path class="object" d="${path([[x - 60, y], [x - 60, y + 70]])}"/><rect class="outline" x="${x - 78}" y="${y + 70}" width="36" height="26"/>`;
  }

  draw(s) {
    const theta = s.theta[this.number], newton = s.torque[this.number] / RADIUS_M, [hx, hy] = at(theta, LENGTH);
    let text = this.number ? this.met(theta) : "";
    text += motor_and_bar(theta);
    if (s.held === this.number) {
      const [gx, gy] = at(s.hand, LENGTH);
      text += `<path class="handline" d="${path([[hx, hy], [gx, gy]])}"/><circle class="handring" cx="${gx}" cy="${gy}" r="19"/>`;
      this.svg.setAttribute("aria-valuenow", this.tab.lead.toFixed(2));
    }
    text += force_at([hx, hy], theta, newton, 18, 90);
    this.svg.innerHTML = text;
  }

  tell(text) {
    this.figure.querySelector(".equation").textContent = text;
  }
}

class CoupledTab {
  constructor(core, numbers) {
    this.loop = new core.Coupled(numbers.coupled.image, numbers.coupled.inertia_kg_m2);
    this.wall = core.COUPLED_WALL_RAD;
    this.most = core.COUPLED_MOST_RAD;
    this.lead = this.held = 0;
    this.trace = [];
    this.values = {};
    this.levers = [0, 1].map((n) => new CoupledLever(this, $("coupled-stages"), n));
    this.sliders = {};
    for (const slider of COUPLING) $("coupled-law").append(this.slider(slider));
    for (const name of Object.keys(MET)) $("coupled-met").append(option(name, name));
    $("coupled-met").oninput = () => this.meet($("coupled-met").value, MET[$("coupled-met").value].strength);
    $("coupled-strength").oninput = () => this.meet(this.met, Number($("coupled-strength").value));
    $("coupled-met").value = "spring";
    this.meet("spring", MET.spring.strength);
    this.seen = this.loop.state();
  }

  slider({ name, label, unit, low, high, step, value }) {
    const line = document.createElement("label"), shown = document.createElement("output");
    const range = Object.assign(document.createElement("input"), { id: `coupled-law-${name}`, type: "range", min: low, max: high, step, value });
    line.className = "slider";
    range.oninput = () => { this.set(name, Number(range.value)); shown.textContent = `${range.value} ${unit}`; };
    range.oninput();
    this.sliders[name] = range;
    line.append(label, range, shown);
    return line;
  }

  set(name, value) {
    this.values[name] = value;
    say(this.loop.set(name, value));
    if (name === "share" && value > MOST_SHARE) this.hold(0);
  }

  meet(what, strength) {
    const { number, low, high, unit } = MET[what];
    this.met = what;
    this.strength = strength;
    say(this.loop.meet(number, strength));
    Object.assign($("coupled-strength"), { min: low, max: high, step: 0.05, value: strength, disabled: !number });
    $("coupled-strength-shown").textContent = number ? `${fixed(strength, 2)} ${unit}` : "";
  }

  /** The hand changes levers where they are. */
  hold(number) {
    if (number === this.held) return;
    this.held = number;
    say(this.loop.hold(number));
    if (number && this.values.share > MOST_SHARE) {
      this.sliders.share.value = 0;
      this.sliders.share.oninput();
    }
    this.lead = this.loop.state().theta[number];
  }

  aim(lead) {
    this.lead = Math.max(-this.most, Math.min(this.most, lead));
  }

  frame(passed) {
    this.loop.lead(this.lead);
    run_timed(passed, () => say(this.loop.advance(passed)));
    this.seen = this.loop.state();
    this.trace.push(this.seen.theta);
    if (this.trace.length > COUPLED_TRACE) this.trace.shift();
    this.levers.forEach((lever) => lever.draw(this.seen));
    this.tell();
    this.draw_angles();
  }

  tell() {
    const s = this.seen, { stiffness: K, share: m } = this.values;
    let felt = `τ₀ = ${fixed(s.torque[0])} Nm, ${fixed(s.theta[0])} rad`;
    if (this.met === "spring") felt += `\nat rest it feels k K/(K + (1 − m) k) = ${fixed((this.strength * K) / (K + (1 - m) * this.strength), 2)} Nm/rad of k = ${fixed(this.strength, 2)}`;
    this.levers[0].tell(`${felt}\nthe law's words at ${fixed(s.rate_hz / 1000, 0)} kHz`);
    this.levers[1].tell(`τ₁ = ${fixed(s.torque[1])} Nm, ${fixed(s.theta[1])} rad\nit meets ${fixed(s.met)} Nm; θ₀ − θ₁ = ${fixed(1000 * (s.theta[0] - s.theta[1]), 1)} mrad`);
  }

  draw_angles() {
    const lines = ["first", "second"].map((text, n) => ({ text, colour: n ? "--red" : "--blue", values: this.trace.map((pair) => pair[n]) }));
    draw_traces($("coupled-angles"), "angle, rad, the last seconds", lines, COUPLED_TRACE, 0.1);
  }
}
