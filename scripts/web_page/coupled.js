// Two levers that only a law couples: either can be dragged, the second one meets something.
"use strict";

const MET = {
  nothing: { number: 0, strength: 0, low: 0, high: 0, unit: "" },
  spring: { number: 1, strength: 1, low: 0.1, high: 4, unit: "Nm/rad" },
  wall: { number: 2, strength: 6, low: 1, high: 20, unit: "Nm/rad" },
  weight: { number: 3, strength: 0.2, low: 0, high: 0.4, unit: "Nm" },
};
const COUPLING = [["stiffness", " Nm/rad"], ["damping", " Nm s/rad"], ["share", ""], ["calm", " Nm s/rad"]];
const MOST_SHARE = 0.5; // with a hand on the second lever: beyond, nothing holds the first one, and it swings
const COUPLED_TRACE = 240; // frames that the curve keeps

class CoupledLever {
  constructor(tab, place, number) {
    this.tab = tab;
    this.number = number;
    const held = (act) => (rad) => { tab.hold(number); act(rad); };
    const leads = { dragged: true, aim: held((rad) => tab.aim(rad)), step: held((rad) => tab.aim(tab.lead + rad)) };
    this.picture = lever_stage(place, `${number ? "second" : "first"} lever`, `${number ? "Second" : "First"} lever`, tab.most, leads);
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
    const theta = s.theta[this.number], held = s.held === this.number;
    if (held) this.picture.svg.setAttribute("aria-valuenow", this.tab.lead.toFixed(2));
    this.picture.svg.innerHTML = (this.number ? this.met(theta) : "") + held_bar(theta, held ? s.hand : undefined, s.torque[this.number] / RADIUS_M);
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
    for (const [name, unit] of COUPLING) wire_slider(`coupled-law-${name}`, (value) => value + unit, (value) => this.set(name, value));
    for (const name of Object.keys(MET)) $("coupled-met").append(option(name, name));
    $("coupled-met").oninput = () => this.meet($("coupled-met").value, MET[$("coupled-met").value].strength);
    $("coupled-strength").oninput = () => this.meet(this.met, Number($("coupled-strength").value));
    $("coupled-met").value = "spring";
    this.meet("spring", MET.spring.strength);
    this.seen = this.loop.state();
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
    this.loop.meet(number, strength);
    Object.assign($("coupled-strength"), { min: low, max: high, step: 0.05, value: strength, disabled: !number });
    $("coupled-strength-shown").textContent = number ? `${fixed(strength, 2)} ${unit}` : "";
  }

  /** The hand changes levers where they are. */
  hold(number) {
    if (number === this.held) return;
    this.held = number;
    this.loop.hold(number === 1);
    if (number && this.values.share > MOST_SHARE) {
      $("coupled-law-share").value = 0;
      $("coupled-law-share").oninput();
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
    keep(this.trace, COUPLED_TRACE, this.seen.theta);
    this.levers.forEach((lever) => lever.draw(this.seen));
    this.tell();
    const lines = ["first", "second"].map((text, n) => ({ text, colour: n ? "--red" : "--blue", values: this.trace.map((pair) => pair[n]) }));
    draw_traces($("coupled-angles"), "angle, rad, the last seconds", lines, COUPLED_TRACE, 0.1);
  }

  tell() {
    const s = this.seen, { stiffness: K, share: m } = this.values;
    let felt = `τ₀ = ${fixed(s.torque[0])} Nm, ${fixed(s.theta[0])} rad`;
    if (this.met === "spring") felt += `\nat rest it feels k K/(K + (1 − m) k) = ${fixed((this.strength * K) / (K + (1 - m) * this.strength), 2)} Nm/rad of k = ${fixed(this.strength, 2)}`;
    this.levers[0].picture.caption.textContent = `${felt}\nthe law's words at ${fixed(s.rate_hz / 1000, 0)} kHz`;
    this.levers[1].picture.caption.textContent = `τ₁ = ${fixed(s.torque[1])} Nm, ${fixed(s.theta[1])} rad\nit meets ${fixed(s.met)} Nm; θ₀ − θ₁ = ${fixed(1000 * (s.theta[0] - s.theta[1]), 1)} mrad`;
  }
}
