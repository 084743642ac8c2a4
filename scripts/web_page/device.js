// One lever: its loop in the core, its picture, the hand of the user on it.
"use strict";

const SAMPLE = ["time", "theta", "hand", "tau_ref", "tau_hat", "torque", "hand_nm", "omega", "float_hat", "position"];
const RADIUS_M = 0.1; // where the hand holds the lever: radius_m of the plants
const VIEW = "-40 -72 580 472"; // of the picture, around CENTRE
const SHOW_S = 4; // of a press that shows how
const CURVES = { chunk_s: 0.01, kept: 800 }; // what they keep: 4 s

/** What can be broken, by its number in the core: what is to be expected, and how a hand shows it. */
const BROKEN = {
  1: { quick: true, expect: "The count stands still, so the ball goes through the object without a force. In quick motion, from about 3 rad/s on, the core notices and switches off: fault channel." },
  2: { lets_go: -0.9, expect: "The count runs backwards, so the motor pushes the ball on where it should push it back. Let go of it there, and it runs away; the core switches off: fault polarity." },
  3: { lets_go: 0.9, expect: "The motor pushes the ball on where it should push it back. Let go of it there, and it runs away; the core switches off: fault polarity." },
  4: { expect: "The motor gives a third of the force that is asked, or less: the ball sinks in deeper. The core does not measure its supply, so there is no fault." },
};

class Device {
  constructor(core, design, plant, place) {
    this.core = core;
    this.name = design;
    this.loop = new core.Loop(design, plant);
    this.info = this.loop.design();
    this.words = {};
    this.ranges = {};
    for (const p of this.loop.parameters()) {
      this.words[p.name] = p.value;
      this.ranges[p.name] = p;
    }
    this.chunk = [];
    this.traces = { theta: [], hand: [], torque: [], tau_ref: [], tau_hat: [], difference: [] };
    this.now = Object.fromEntries(SAMPLE.map((n) => [n, 0]));
    this.lead = 0;
    this.build(place);
  }

  build(place) {
    this.figure = document.createElement("figure");
    this.figure.innerHTML = `<svg viewBox="${VIEW}" tabindex="0" role="slider" aria-label="Lever of design ${this.name}: the hand's angle in rad"
      aria-valuemin="-1.5" aria-valuemax="1.5" aria-valuenow="0"><rect class="board" x="-14" y="44" width="528" height="346" rx="20"/><g class="objects"></g><g class="over"></g></svg>
      <div class="alarm" role="alert" hidden><span></span> <button type="button">Recover</button></div>
      <figcaption><details><summary><span class="name"></span>, <span class="state" role="status"></span></summary><div class="equation"></div></details></figcaption>`;
    this.figure.querySelector(".name").textContent = `Design ${this.name}`;
    this.svg = this.figure.querySelector("svg");
    const fold = this.figure.querySelector("details");
    fold.open = page.told; // as with the lever before
    fold.ontoggle = () => (page.told = fold.open);
    this.alarm = this.figure.querySelector(".alarm");
    this.alarm.querySelector("button").onclick = recover;
    this.parts = Object.fromEntries(["objects", "over"].map((n) => [n, this.figure.querySelector("." + n)]));
    place.append(this.figure);
    led_by(this.svg, taken(this, { ArrowLeft: -0.02, ArrowRight: 0.02, ArrowDown: -0.1, ArrowUp: 0.1 }, (event) => this.point(event)));
  }

  /** Somebody takes the lever, or lets go; the hand that showed how is gone for good. */
  take(held) {
    if (held && (!this.held || page.shows)) this.lead = this.now.theta;
    page.shows = false;
    this.held = held;
    this.loop.hold(held ? page.grip : 0);
    this.svg.classList.toggle("held", held);
  }

  /** Nobody's hand, which shows how: it presses for a while and lets go; or what is broken, in its way. */
  show(seconds) {
    const part = seconds % SHOW_S, way = (from, to) => { const x = Math.max(0, Math.min(1, (part - from) / (to - from))); return x * x * (3 - 2 * x); };
    const broken = BROKEN[$("break").value];
    const grip = broken && broken.lets_go && part > 0.75 ? 0 : broken && broken.quick ? 3 : 1;
    if (grip !== this.grip || !grip === !!this.held) this.loop.hold(grip);
    this.grip = grip;
    this.held = grip > 0;
    if (!grip) return;
    if (broken && broken.quick) this.aim(seconds % 0.8 < 0.4 ? 0.8 : 0);
    else if (broken && broken.lets_go) this.aim(broken.lets_go * way(0, 1));
    else this.aim(this.scene === "wall" ? 0.05 + 0.95 * (way(0, 1) - way(2.4, 3.4)) : 0.9 * Math.sin((2 * Math.PI * seconds) / SHOW_S));
  }

  /** Forgets its faults now, and arms with the next frame: the core is to see the request low first. */
  recover() {
    this.loop.stop(false);
    this.loop.clearFaults();
    this.rearm = true;
  }

  point(event) {
    const [x, y] = pointed(event, this.svg);
    this.aim(Math.atan2(x - CENTRE[0], Math.max(CENTRE[1] - y, -40)));
  }

  aim(theta) {
    this.lead = Math.max(-1.5, Math.min(1.5, theta));
  }

  set(name, value) {
    const said = this.loop.set(name, value);
    if (!said) this.words[name] = value;
    return said;
  }

  select(scene) {
    this.scene = scene;
    this.geometry = geometry(scene, this.words, this.info.count_rad);
    return this.loop.select(scene);
  }

  /** One tick, in which the hand stands still. */
  step() {
    return this.advance(1, 1, this.status.hand_rad);
  }

  /** Runs for so many ticks; returns an error or nothing. */
  advance(ticks, every = 200, lead = this.lead) {
    this.loop.lead(lead);
    const said = this.loop.advance(ticks, every);
    const samples = this.loop.samples();
    for (let i = 0; i < samples.length; i += SAMPLE.length) this.note(Object.fromEntries(SAMPLE.map((name, n) => [name, samples[i + n]])));
    this.status = this.loop.status();
    if (this.rearm && !said) {
      this.rearm = false;
      this.loop.arm(true);
    }
    return said;
  }

  /** The curves keep the least and the largest value of each 10 ms, so that no spike is lost. */
  note(sample) {
    this.now = sample;
    this.chunk.push({ ...sample, difference: 1e6 * (sample.tau_hat - sample.float_hat) });
    if (sample.time - this.chunk[0].time < CURVES.chunk_s) return;
    for (const [name, trace] of Object.entries(this.traces)) {
      const values = this.chunk.map((row) => row[name]);
      keep(trace, CURVES.kept, Math.min(...values));
      keep(trace, CURVES.kept, Math.max(...values));
    }
    this.chunk = [];
  }

  draw(values) {
    const s = { ...this.now, tau: this.now.tau_ref, held: this.held }, g = this.geometry || {};
    this.parts.objects.innerHTML = drawing(this.scene, g, s);
    const ball = at(s.theta, LENGTH), newton = s.torque / RADIUS_M;
    let over = motor_and_bar(s.theta);
    if (this.held) {
      if (!page.shows) over += hand_ring(ball, at(s.hand, LENGTH), 26);
      over += hand_at(s.theta, s.hand - s.theta);
    }
    over += force_at(ball, s.theta, newton, 70, 100) + this.newton_text(s.theta, newton);
    if (!this.status.armed) over += `<text class="off" x="${CENTRE[0]}" y="${CENTRE[1] - 78}">motor off</text>`;
    this.parts.over.innerHTML = over;
    const state = this.figure.querySelector(".state"), st = this.status;
    const warm = st.torque_limit_nm < this.words.torque_limit - 0.001 ? `; the motor is warm and gives up to ${fixed(st.torque_limit_nm / RADIUS_M, 1)} N` : "";
    const fault = st.faults && `fault: ${st.faults}` + (FAULTS[st.faults] ? ` (${FAULTS[st.faults]})` : "");
    const text = fault || (st.armed ? "armed" + (st.limits ? `, limited: ${st.limits}` : "") + warm : "disarmed");
    if (state.textContent !== text) {
      state.textContent = text;
      state.className = "state " + (fault ? "fault" : st.armed ? "armed" : "");
      this.svg.classList.toggle("faulted", !!fault);
      this.alarm.hidden = !fault;
      this.alarm.firstChild.textContent = `${text[0].toUpperCase()}${text.slice(1)}. The motor is off: the handle is loose.`;
    }
    const law = SCENES[this.scene].law({ ...values, ...g }, s);
    this.figure.querySelector(".equation").textContent =
      `${law}\nasked ${fixed(s.tau_ref)} Nm, motor ${fixed(s.torque)} Nm, observed ${fixed(s.tau_hat)} Nm\nF = τ/r = ${fixed(s.torque)} / ${RADIUS_M} = ${fixed(newton, 2)} N`;
    this.svg.setAttribute("aria-valuenow", this.lead.toFixed(2));
    this.svg.setAttribute("aria-valuetext", `lever at ${s.theta.toFixed(2)} rad, ${newton.toFixed(1)} newton`);
  }

  /** The force on the fingertip, at the head of its arrow. */
  newton_text(theta, newton) {
    if (Math.abs(newton) > 0.05) this.side = Math.sign(newton);
    const side = this.side ||= -1, reach = side * (34 + Math.min(100, 70 * Math.abs(newton))), [hx, hy] = at(theta, LENGTH);
    const x = Math.max(side < 0 ? 110 : 0, Math.min(side < 0 ? 500 : 378, hx + reach * Math.cos(theta))), y = Math.max(-30, Math.min(380, hy + reach * Math.sin(theta)));
    return `<text class="newton" text-anchor="${side < 0 ? "end" : "start"}" x="${x.toFixed(1)}" y="${(y + 8).toFixed(1)}">${fixed(Math.abs(newton), 2)} N</text>`;
  }

  remove() {
    this.figure.remove();
    this.loop.delete();
  }
}
