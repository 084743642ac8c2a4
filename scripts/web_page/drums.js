// Three drums under a stick: the mouse carries the wrist and leads the stick, hits are heard.
"use strict";

const STICK_M = 0.3; // `length` of the law
const DRUMS = [-0.3, 0, 0.3]; // where they stand, across, of the law
const HALF_M = 0.12;
const HALL = { width: 480, height: 400, x: 240, y: 290, across: 430, ahead: 150, up: 800 };
const STROKE_S = 0.15; // how long the space bar presses
// The sound of scripts/drums_sound.py: modes of an ideal round membrane under an envelope.
const MODES = [1, 1.594, 2.136, 2.296, 2.653], PITCH_HZ = [180, 120, 75], LOUDEST_M_S = 3;
const ATTACK_S = 0.002, DECAY_S = 0.05, SUSTAIN_S = 0.4, RELEASE_S = 0.08, SUSTAIN_LEVEL = 0.4;

const in_hall = (across, ahead, height) => [HALL.x + HALL.across * across, HALL.y - HALL.ahead * ahead - HALL.up * height];

/** Levels of a hit by time, s, straight between them; place 0 is the middle, 1 the rim. */
function drum_envelope(speed_m_s, place) {
  const loud = Math.min(1, Math.max(0, speed_m_s) / LOUDEST_M_S), held = ATTACK_S + DECAY_S + SUSTAIN_S * (1 - Math.min(1, Math.max(0, place)));
  return [[0, 0], [ATTACK_S, loud], [ATTACK_S + DECAY_S, loud * SUSTAIN_LEVEL], [held, loud * SUSTAIN_LEVEL], [held + RELEASE_S, 0]];
}

/** Plays a hit of drum 1 to 3, full scale 1. */
function play_drum(audio, drum, speed_m_s, place) {
  const envelope = drum_envelope(speed_m_s, place), gain = new GainNode(audio, { gain: 0 }), now = audio.currentTime;
  const whole = MODES.reduce((sum, _, n) => sum + 1 / (n + 1), 0);
  for (const [after, level] of envelope) gain.gain.linearRampToValueAtTime(level, now + after);
  gain.connect(audio.destination);
  MODES.forEach((mode, n) => {
    const tone = new OscillatorNode(audio, { frequency: PITCH_HZ[drum - 1] * mode });
    tone.connect(new GainNode(audio, { gain: 1 / (n + 1) / whole })).connect(gain);
    tone.start(now);
    tone.stop(now + envelope.at(-1)[0]);
  });
}

class DrumsTab {
  constructor(core, numbers) {
    this.stick = core.Lever.stick(numbers.drums);
    this.across = 0;
    this.lead = 0.3;
    this.hits = [];
    this.played = 0;
    this.lit = [0, 0, 0];
    this.seen = this.stick.state();
    const steps = { ArrowLeft: [-0.02, 0], ArrowRight: [0.02, 0], ArrowUp: [0, 0.05], ArrowDown: [0, -0.05] };
    Object.assign(this, make_stage($("drums-stage"), `0 0 ${HALL.width} ${HALL.height}`, "Drums: the stick follows the mouse; arrow keys move it, the space bar strikes", {
      point: (event) => this.point(event),
      steps,
      step: ([across, lead]) => this.aim(this.across + across, this.lead + lead),
      space: () => (this.stroke = STROKE_S),
    }));
    for (const n of [1, 2, 3]) wire_slider(`drums-skin${n}`, (value) => `${value} N/m`, (value) => say(this.stick.set(`skin${n}`, value)));
    sound_button("drums-sound", () => this.is_heard(), (wanted) => (wanted ? (this.audio ??= new AudioContext()).resume() : this.audio.suspend()));
  }

  is_heard() {
    return this.audio && this.audio.state === "running";
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
      if (name.startsWith("hit")) keep(this.hits, 500, { drum, speed: value, time });
      else this.hit(drum, value);
    }
    this.draw();
  }

  /** The place comes after its hit. */
  hit(drum, place) {
    const hit = this.hits[this.hits.length - 1];
    hit.place = place;
    this.lit[drum - 1] = 0.15;
    add_row($("drums-hits"), [`drum ${drum}`, `${fixed(hit.speed, 2)} m/s`, `${fixed(place, 2)} to the rim`], 0);
    if ($("drums-hits").rows.length > 8) $("drums-hits").deleteRow(8);
    if (!this.is_heard()) return;
    play_drum(this.audio, drum, hit.speed, place);
    ++this.played;
  }

  draw() {
    const s = this.seen, newton = s.torque / STICK_M;
    const place = (theta) => in_hall(this.across, STICK_M * Math.cos(theta), STICK_M * Math.sin(theta));
    const wrist = in_hall(this.across, 0, 0), tip = place(s.theta), hand = place(s.hand), below = in_hall(this.across, STICK_M * Math.cos(s.theta), 0);
    let text = DRUMS.map((across, n) => {
      const [x, y] = in_hall(across, STICK_M, 0), rx = HALF_M * HALL.across, ry = HALF_M * HALL.ahead;
      const corners = path([[x - rx, y + ry], [x - rx + 14, y - ry], [x + rx - 14, y - ry], [x + rx, y + ry]]);
      return `<path class="outline${this.lit[n] ? " lit" : ""}" d="${corners}Z"/><path class="outline" d="${path([[x - rx, y + ry], [x - rx, y + 70], [x + rx, y + 70], [x + rx, y + ry]])}"/><text class="label" x="${x}" y="${y + 50}">${n + 1}</text>`;
    }).join("");
    text += `<ellipse class="joint" cx="${below[0]}" cy="${below[1]}" rx="7" ry="3"/><path class="lever" d="${path([wrist, tip])}"/>${circle("knob", tip, 8)}` +
      hand_ring(tip, hand, 12) + arrow(tip, 0, -Math.min(150, 30 * newton), "force");
    this.svg.innerHTML = text;
    this.caption.textContent = `τ = skin · d² = ${fixed(s.torque)} Nm, ${fixed(newton, 2)} N at the tip; the stick at ${s.counts} counts\nthe law's words at ${fixed(s.rate_hz / 1000, 0)} kHz`;
  }
}
