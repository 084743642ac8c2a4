// Three drums under a stick: the mouse carries the wrist and leads the stick, hits are heard.
"use strict";

const STICK_M = 0.3; // `length` of the law
const DRUMS = [{ across: -0.3, skin: 900 }, { across: 0, skin: 600 }, { across: 0.3, skin: 300 }]; // of the law
const HALF_M = 0.12;
const HALL = { width: 480, height: 400, x: 240, y: 290, across: 430, ahead: 150, up: 800 };
const STROKE_S = 0.15; // how long the space bar presses
// The sound of scripts/drums_sound.py: modes of an ideal round membrane under an envelope.
const MODES = [1, 1.594, 2.136, 2.296, 2.653], PITCH_HZ = [180, 120, 75], LOUDEST_M_S = 3;
const ATTACK_S = 0.002, DECAY_S = 0.05, SUSTAIN_S = 0.4, RELEASE_S = 0.08, SUSTAIN_LEVEL = 0.4;

const in_hall = (across, ahead, height) => [HALL.x + HALL.across * across, HALL.y - HALL.ahead * ahead - HALL.up * height];

/** One hit of drum 1 to 3, full scale 1; place 0 is the middle, 1 the rim. */
function drum_samples(drum, speed_m_s, place, rate_hz) {
  const sustain = SUSTAIN_S * (1 - Math.min(1, Math.max(0, place))), loud = Math.min(1, Math.max(0, speed_m_s) / LOUDEST_M_S);
  const corners = [[0, 0], [ATTACK_S, 1], [ATTACK_S + DECAY_S, SUSTAIN_LEVEL], [ATTACK_S + DECAY_S + sustain, SUSTAIN_LEVEL], [ATTACK_S + DECAY_S + sustain + RELEASE_S, 0]];
  const samples = new Float32Array(Math.floor(corners[4][0] * rate_hz)), whole = MODES.reduce((sum, _, n) => sum + 1 / (n + 1), 0);
  let corner = 0;
  for (let i = 0; i < samples.length; ++i) {
    const t = i / rate_hz;
    while (corner < 3 && t >= corners[corner + 1][0]) ++corner;
    const [[t0, a], [t1, b]] = [corners[corner], corners[corner + 1]];
    const tones = MODES.reduce((sum, mode, n) => sum + Math.sin(2 * Math.PI * PITCH_HZ[drum - 1] * mode * t) / (n + 1), 0);
    samples[i] = (loud * (a + ((b - a) * (t - t0)) / (t1 - t0)) * tones) / whole;
  }
  return samples;
}

class DrumsTab {
  constructor(core, numbers) {
    this.stick = new core.Stick(numbers.drums);
    this.across = 0;
    this.lead = 0.3;
    this.hits = [];
    this.played = 0;
    this.lit = [0, 0, 0];
    this.seen = this.stick.state();
    $("drums-stage").innerHTML = `<svg viewBox="0 0 ${HALL.width} ${HALL.height}" tabindex="0" role="application"
      aria-label="Drums: the stick follows the mouse; arrow keys move it, the space bar strikes"></svg><figcaption><span class="equation"></span></figcaption>`;
    this.svg = $("drums-stage").querySelector("svg");
    this.caption = $("drums-stage").querySelector(".equation");
    this.svg.addEventListener("pointerdown", (event) => this.svg.setPointerCapture(event.pointerId));
    for (const kind of ["pointerdown", "pointermove"]) this.svg.addEventListener(kind, (event) => this.point(event));
    this.svg.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [-0.02, 0], ArrowRight: [0.02, 0], ArrowUp: [0, 0.05], ArrowDown: [0, -0.05] }[event.key];
      if (step) this.aim(this.across + step[0], this.lead + step[1]);
      else if (event.key === " ") this.stroke = STROKE_S;
      else return;
      event.preventDefault();
    });
    DRUMS.forEach((drum, n) => {
      const label = document.createElement("label"), shown = document.createElement("output");
      const range = Object.assign(document.createElement("input"), { id: `drums-skin${n + 1}`, type: "range", min: 0, max: 2000, step: 10, value: drum.skin });
      label.className = "slider";
      range.oninput = () => { say(this.stick.set(`skin${n + 1}`, Number(range.value))); shown.textContent = `${range.value} N/m`; };
      shown.textContent = `${drum.skin} N/m`;
      label.append(`skin ${n + 1}`, range, shown);
      $("drums-skins").append(label);
    });
    $("drums-sound").onclick = () => this.hear(!this.audio || this.audio.state !== "running");
  }

  hear(wanted) {
    if (wanted) {
      this.audio ??= new AudioContext();
      this.audio.resume();
    } else this.audio.suspend();
    $("drums-sound").setAttribute("aria-pressed", wanted);
    $("drums-sound").textContent = wanted ? "Sound off" : "Sound on";
  }

  point(event) {
    const [x, y] = pointed(event, this.svg);
    const level = in_hall(0, STICK_M, 0)[1];
    this.aim((x - HALL.x) / HALL.across, Math.asin(Math.max(-1, Math.min(1, (level - y) / HALL.up / STICK_M))));
  }

  aim(across, lead) {
    this.across = Math.max(-0.5, Math.min(0.5, across));
    this.lead = Math.max(-0.6, Math.min(0.6, lead));
  }

  frame(passed) {
    this.stroke = Math.max(0, (this.stroke || 0) - passed);
    this.stick.lead(this.stroke > 0 ? -0.3 : this.lead);
    run_timed(passed, () => {
      say(this.stick.set("across", this.across));
      say(this.stick.advance(passed));
    });
    this.seen = this.stick.state();
    this.lit = this.lit.map((left) => Math.max(0, left - passed));
    for (const { name, value, time } of this.seen.events) {
      const drum = Number(name.slice(-1));
      if (name.startsWith("hit")) this.hits.push({ drum, speed: value, time });
      else this.hit(drum, value);
    }
    this.draw();
  }

  /** The place comes after its hit. */
  hit(drum, place) {
    const hit = this.hits[this.hits.length - 1];
    hit.place = place;
    this.lit[drum - 1] = 0.15;
    if (this.hits.length > 500) this.hits.shift();
    const row = $("drums-hits").insertRow(0);
    [`drum ${drum}`, `${fixed(hit.speed, 2)} m/s`, `${fixed(place, 2)} to the rim`].forEach((text) => (row.insertCell().textContent = text));
    if ($("drums-hits").rows.length > 8) $("drums-hits").deleteRow(8);
    if (!this.audio || this.audio.state !== "running") return;
    const samples = drum_samples(drum, hit.speed, place, this.audio.sampleRate);
    const buffer = this.audio.createBuffer(1, samples.length, this.audio.sampleRate), source = this.audio.createBufferSource();
    buffer.copyToChannel(samples, 0);
    source.buffer = buffer;
    source.connect(this.audio.destination);
    source.start();
    ++this.played;
  }

  draw() {
    const s = this.seen, newton = s.torque / STICK_M;
    const place = (theta) => in_hall(this.across, STICK_M * Math.cos(theta), STICK_M * Math.sin(theta));
    const wrist = in_hall(this.across, 0, 0), tip = place(s.theta), hand = place(s.hand), below = in_hall(this.across, STICK_M * Math.cos(s.theta), 0);
    let text = DRUMS.map((drum, n) => {
      const [x, y] = in_hall(drum.across, STICK_M, 0), rx = HALF_M * HALL.across, ry = HALF_M * HALL.ahead;
      const corners = path([[x - rx, y + ry], [x - rx + 14, y - ry], [x + rx - 14, y - ry], [x + rx, y + ry]]);
      return `<path class="outline${this.lit[n] ? " lit" : ""}" d="${corners}Z"/><path class="outline" d="${path([[x - rx, y + ry], [x - rx, y + 70], [x + rx, y + 70], [x + rx, y + ry]])}"/><text class="label" x="${x}" y="${y + 50}">${n + 1}</text>`;
    }).join("");
    text += `<ellipse class="joint" cx="${below[0]}" cy="${below[1]}" rx="7" ry="3"/><path class="lever" d="${path([wrist, tip])}"/><circle class="knob" cx="${tip[0]}" cy="${tip[1]}" r="8"/>` +
      `<path class="handline" d="${path([tip, hand])}"/><circle class="handring" cx="${hand[0]}" cy="${hand[1]}" r="12"/>`;
    const long = Math.min(150, 30 * newton);
    if (long > 2) text += `<path class="force" d="${path([tip, [tip[0], tip[1] - long + 6]])}"/><path class="forcehead" d="${path([[tip[0], tip[1] - long], [tip[0] - 6, tip[1] - long + 9], [tip[0] + 6, tip[1] - long + 9]])}Z"/>`;
    this.svg.innerHTML = text;
    this.caption.textContent = `τ = skin · d² = ${fixed(s.torque)} Nm, ${fixed(newton, 2)} N at the tip; the stick at ${s.counts} counts\nthe law's words at ${fixed(s.rate_hz / 1000, 0)} kHz`;
  }
}
