// One lever: its loop in the core, its picture, the hand of the user on it.
"use strict";

const SAMPLE = ["time", "theta", "hand", "tau_ref", "tau_hat", "torque", "hand_nm", "omega", "float_hat", "position"];
const RADIUS_M = 0.1; // where the hand holds the lever: radius_m of the plants
const KEPT = 20000; // samples of the curves: 4 s at 5 kHz

class Device {
  constructor(core, design, own, plant, place) {
    this.core = core;
    this.own = own; // a user's design on the core of `design`, or null
    this.name = own ? own.name : design;
    this.loop = new core.Loop(design, plant);
    this.info = this.loop.design();
    this.words = {};
    this.ranges = {};
    for (const p of this.loop.parameters()) {
      this.words[p.name] = p.value;
      this.ranges[p.name] = p;
    }
    if (own) for (const { name, value } of own.values) this.set(name, value);
    this.history = { length: 0, next: 0, ...Object.fromEntries(SAMPLE.map((n) => [n, new Float32Array(KEPT)])) };
    this.now = Object.fromEntries(SAMPLE.map((n) => [n, 0]));
    this.lead = 0;
    this.difference = 0;
    this.build(place);
  }

  build(place) {
    this.figure = document.createElement("figure");
    this.figure.innerHTML = `<svg viewBox="0 0 500 400" tabindex="0" role="slider" aria-label="Lever of design ${this.name}: the hand's angle in rad"
      aria-valuemin="-1.5" aria-valuemax="1.5" aria-valuenow="0"><g class="under"></g><g class="objects"></g><g class="over"></g></svg>
      <div class="alarm" role="alert" hidden><span></span> <button type="button">Recover</button></div>
      <figcaption><span class="name"></span> <span class="state" role="status"></span><div class="equation"></div></figcaption>`;
    this.figure.querySelector(".name").textContent = `Design ${this.name}`;
    this.svg = this.figure.querySelector("svg");
    this.alarm = this.figure.querySelector(".alarm");
    this.alarm.querySelector("button").onclick = recover;
    this.parts = Object.fromEntries(["under", "objects", "over"].map((n) => [n, this.figure.querySelector("." + n)]));
    let scale = `<path class="scale" d="${path(arc(-1.55, 1.55, LENGTH + 16))}"/>`;
    for (let mark = -1.5; mark <= 1.51; mark += 0.5) {
      const [x, y] = at(mark, LENGTH + 34);
      scale += `<path class="scale" d="${ray(mark, LENGTH + 11, LENGTH + 21)}"/><text x="${x - 12}" y="${y + 4}">${fixed(mark, 1)}</text>`;
    }
    this.parts.under.innerHTML = scale;
    place.append(this.figure);
    this.svg.addEventListener("pointerdown", (event) => {
      this.svg.setPointerCapture(event.pointerId);
      this.take(true);
      this.point(event);
    });
    this.svg.addEventListener("pointermove", (event) => this.svg.hasPointerCapture(event.pointerId) && this.point(event));
    for (const end of ["pointerup", "pointercancel"]) this.svg.addEventListener(end, () => this.take(false));
    this.svg.addEventListener("keydown", (event) => {
      const steps = { ArrowLeft: -0.02, ArrowRight: 0.02, ArrowDown: -0.1, ArrowUp: 0.1 };
      if (event.key === " ") this.take(!this.held);
      else if (event.key in steps) {
        this.take(true);
        this.aim(this.lead + steps[event.key]);
      } else return;
      event.preventDefault();
    });
  }

  take(held) {
    if (held && !this.held) this.lead = this.now.theta;
    this.held = held;
    this.loop.hold(held ? page.grip : 0);
    this.svg.classList.toggle("held", held);
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

  /** Runs for so many ticks; returns an error or nothing. */
  advance(ticks) {
    this.loop.lead(this.lead);
    const said = this.loop.advance(ticks, 200);
    const samples = this.loop.samples(), h = this.history;
    for (let i = 0; i < samples.length; i += SAMPLE.length) {
      for (let n = 0; n < SAMPLE.length; ++n) h[SAMPLE[n]][h.next] = samples[i + n];
      h.next = (h.next + 1) % KEPT;
      h.length = Math.min(h.length + 1, KEPT);
    }
    const last = samples.length - SAMPLE.length;
    if (last >= 0) SAMPLE.forEach((n, i) => (this.now[n] = samples[last + i]));
    this.status = this.loop.status();
    this.difference = Math.max(this.difference, this.status.difference_nm);
    if (this.rearm && !said) {
      this.rearm = false;
      this.loop.arm(true);
    }
    return said;
  }

  draw(values) {
    const s = { ...this.now, tau: this.now.tau_ref, held: this.held }, g = this.geometry || {};
    this.parts.objects.innerHTML = drawing(this.scene, g, s);
    const [hx, hy] = at(s.theta, LENGTH), newton = s.torque / RADIUS_M;
    let over = `<path class="lever" d="${ray(s.theta, 0, LENGTH)}"/><circle class="hub" cx="${CENTRE[0]}" cy="${CENTRE[1]}" r="16"/><circle class="knob" cx="${hx}" cy="${hy}" r="12"/>`;
    if (this.held) {
      const [gx, gy] = at(s.hand, LENGTH);
      over += `<path class="handline" d="${path([[hx, hy], [gx, gy]])}"/><circle class="handring" cx="${gx}" cy="${gy}" r="19"/>`;
    }
    over += force_at([hx, hy], s.theta, newton, 18, 90);
    if (!this.status.armed) over += `<text class="off" x="${hx}" y="${hy - 26}">motor off</text>`;
    over += `<text x="12" y="24">${fixed(newton, 2)} N at the handle</text><text x="12" y="42">${fixed(s.theta)} rad</text>`;
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

  remove() {
    this.figure.remove();
    this.loop.delete();
  }
}
