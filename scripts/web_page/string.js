// A bowed string: the lever draws the bow; what comes to the bridge is drawn and heard.
"use strict";

const PERIOD_S = 1 / 196, WAVE_Z = 0.35, BRIDGE_R = 20, DROP = 0.5, REACH_M = 0.1; // of the law
const BOWING = { width: 560, height: 420, x: 380, nut: 34, bridge: 354, lever: [130, 398], arm: 100, wide: 15 };
const HEARD_S = 0.06, DRAWN_S = 0.025; // of what is heard: kept, drawn
const JUDGED_S = 0.25; // as in docs/devices/strings-and-drums.md: every slip within 5 % of a period
const SLOW_HZ = 0.4; // periods of the drawn string a second
const LOUDEST = 2.5; // m/s that are full scale, as in scripts/bowed_string_sound.py
const QUEUE_S = 0.05, QUEUE_MOST_S = 0.12; // of sound that waits to be played
const LAW_HZ = 40_000; // of the string at its own rate

/** Forces, N, between which a string has one slip a period: Schelleng 1973. */
const schelleng = (bow_m_s, place) => [(WAVE_Z ** 2 * bow_m_s) / (2 * BRIDGE_R * place ** 2 * DROP), (2 * WAVE_Z * bow_m_s) / (place * DROP)];

/** Plays what it is fed, in buffers end to end, never more than QUEUE_MOST_S late; the browser brings the law's rate to
 * that of the loudspeaker, and a value of a slower law holds until the next. */
class StringSound {
  constructor() {
    this.audio = new AudioContext({ sampleRate: LAW_HZ });
    this.next = this.played = 0;
  }

  feed(values, rate_hz) {
    if (this.audio.state !== "running" || !values.length) return;
    const now = this.audio.currentTime, waits = this.next - now, held = Math.round(LAW_HZ / rate_hz);
    if (waits > QUEUE_MOST_S) return; // too long a queue loses this buffer
    const samples = Float32Array.from({ length: held * values.length }, (_, n) => Math.max(-1, Math.min(1, values[Math.floor(n / held)] / LOUDEST)));
    if (waits < 0.003) { // it ran dry, or begins
      this.next = now + QUEUE_S;
      for (let i = 0; i < 100; ++i) samples[i] *= i / 100; // no click
    }
    play(this.audio, samples, this.next);
    this.next += samples.length / LAW_HZ;
    this.played += samples.length;
  }

  hear(wanted) {
    this.next = 0;
    return wanted ? this.audio.resume() : this.audio.suspend();
  }
}

class StringTab {
  constructor(core, numbers) {
    this.core = core;
    this.strings = numbers.strings;
    this.lead = this.phase = 0;
    this.alone = false; // whether the bow goes by itself
    const steps = { ArrowLeft: -0.05, ArrowRight: 0.05, ArrowUp: 0.1, ArrowDown: -0.1 };
    const step = (by, { key }) => {
      if (key === "ArrowLeft" || key === "ArrowRight") { this.draw_alone(false); this.aim(this.lead + by); return; }
      $("string-force").value = Number($("string-force").value) + by;
      $("string-force").oninput();
    };
    Object.assign(this, make_stage($("string-stage"), `0 0 ${BOWING.width} ${BOWING.height}`,
      "Bow on a string: the bow follows the mouse; arrow keys left and right draw it, up and down change its force, the space bar lets it go by itself",
      { down: () => this.draw_alone(false), point: (event) => this.point(event), steps, step }));
    document.addEventListener("keydown", (event) => {
      if (page.tab !== "string" || event.key !== " " || /SELECT|BUTTON|TEXTAREA/.test(event.target.tagName)) return;
      event.preventDefault();
      this.draw_alone(!this.alone);
    });
    this.choose(0);
    for (const [name, digits, unit] of [["force", 2, " N"], ["place", 3, ""], ["speed", 2, " m/s"]]) {
      wire_slider(`string-${name}`, (value) => fixed(value, digits) + unit, (value) => this.turned(name, value));
    }
    $("string-rate").oninput = () => this.choose(Number($("string-rate").value));
    $("string-alone").onclick = () => this.draw_alone(!this.alone);
    sound_button("string-sound", () => this.is_heard(), (wanted) => (this.sound ??= new StringSound()).hear(wanted));
  }

  /** A fresh string, of the law at its own rate (0) or at a host's (1). */
  choose(which) {
    if (this.bow) this.bow.delete();
    const { image, heard } = this.strings[which];
    this.bow = this.core.Lever.bow(image, heard);
    this.seen = this.bow.state();
    this.trace = new Float32Array(Math.round(HEARD_S * this.seen.rate_hz));
    this.slips = [];
    this.lead = this.quick = 0;
    for (const name of ["force", "place", "speed"]) this.turned(name, Number($(`string-${name}`).value));
  }

  turned(name, value) {
    this[name] = value;
    if (name !== "speed") say(this.bow.set(name, value));
    else this.bow.draw(this.alone ? value : 0);
  }

  draw_alone(wanted) {
    if (this.alone && !wanted) this.lead = this.seen.hand;
    this.alone = wanted;
    this.bow.draw(wanted ? this.speed : 0);
    press("string-alone", wanted, wanted ? "Bow by hand" : "Bow by itself");
  }

  is_heard() {
    return this.sound && this.sound.audio.state === "running";
  }

  point(event) {
    const [x, y] = pointed(event, this.svg);
    if (!this.alone) this.aim(Math.atan2(x - BOWING.lever[0], Math.max(BOWING.lever[1] - y, 1)));
  }

  aim(lead) {
    this.lead = Math.max(-1, Math.min(1, lead));
  }

  frame(passed) {
    this.bow.lead(this.lead);
    run_timed(passed, () => say(this.bow.advance(passed)));
    this.seen = this.bow.state();
    const heard = this.bow.watched().slice(), { trace, seen } = this;
    trace.copyWithin(0, heard.length);
    trace.set(heard.subarray(Math.max(0, heard.length - trace.length)), Math.max(0, trace.length - heard.length));
    this.slips = this.slips.concat(seen.events.map(({ value, time }) => ({ time, since: value }))).filter((slip) => slip.time > seen.time - JUDGED_S);
    this.quick += (1 - Math.exp(-passed / 0.1)) * (Math.abs(REACH_M * seen.speed) - this.quick);
    this.phase = (this.phase + passed * SLOW_HZ) % 1;
    if (this.sound) this.sound.feed(heard, seen.rate_hz);
    this.judged = this.judge();
    this.draw();
    this.draw_heard();
    this.draw_forces();
    $("string-late").textContent = this.is_heard() && page.speed && page.speed < 1.1
      ? "The law takes longer here than it lasts: the sound breaks up." : "";
  }

  /** What the law's slips of the last quarter of a second say. */
  judge() {
    const since = this.slips.slice(1).map((slip) => slip.since), count = since.length;
    if (count < 2) return { count: 0, helmholtz: false };
    const least = Math.min(...since), most = Math.max(...since), mean = since.reduce((sum, s) => sum + s, 0) / count;
    const whole = this.slips[0].time < this.seen.time - JUDGED_S + 1.1 * PERIOD_S && this.slips[count].time > this.seen.time - 1.1 * PERIOD_S;
    const one = whole && least > 0.95 * PERIOD_S && most < 1.05 * PERIOD_S;
    // Below the least force a faint motion may have one slip a period too.
    const loud = Math.max(...this.trace) > this.bow_speed() / this.place / 4;
    return { count, least, most, mean, one, helmholtz: one && loud };
  }

  /** The last slip after which there is so much of the trace; else undefined. */
  slip_before(seconds) {
    const late = this.seen.time - seconds, early = this.seen.time - HEARD_S + PERIOD_S / 2;
    return this.slips.filter((slip) => slip.time <= late && slip.time >= early).pop();
  }

  /** Way of the string, m, at shares of its length from the bridge: the wave that goes to the bridge less the
      one that comes back, as a string without losses would have it. The mean over a period is left out: it is the string
      that the bow pulls aside when it turns around. */
  shape(points) {
    const slip = this.slip_before(1.6 * PERIOD_S), { trace, seen } = this, dt = 1 / seen.rate_hz;
    const time = slip ? slip.time + this.phase * PERIOD_S : seen.time - PERIOD_S;
    const ways = new Float64Array(trace.length + 1);
    trace.forEach((v, i) => (ways[i + 1] = ways[i] + v * dt));
    const way = (t) => {
      const at = Math.max(0, Math.min(trace.length - 1e-6, trace.length - (seen.time - t) / dt)), n = Math.floor(at);
      return ways[n] + (ways[n + 1] - ways[n]) * (at - n);
    };
    const around = (share) => way(time + (share * PERIOD_S) / 2) - way(time - (share * PERIOD_S) / 2), whole = around(1);
    return points.map((share) => around(share) - share * whole);
  }

  draw() {
    const s = this.seen, b = BOWING, long = b.bridge - b.nut, level = b.bridge - long * this.place;
    const turn = (theta, r = b.arm) => [b.lever[0] + r * Math.sin(theta), b.lever[1] - r * Math.cos(theta)];
    const handle = turn(s.theta), hand = turn(s.hand), frog = handle[0], newton = s.mean_torque / REACH_M;
    const points = Array.from({ length: 61 }, (_, i) => i / 60);
    const string = this.shape(points).map((m, i) => [b.x + 1000 * b.wide * m, b.bridge - long * points[i]]);
    let text = `<path class="object" d="${path([[b.x - 70, b.nut], [b.x + 70, b.nut]])}"/><path class="solid" d="${path([[b.x - 70, b.bridge], [b.x + 70, b.bridge], [b.x + 52, b.bridge + 26], [b.x - 52, b.bridge + 26]])}Z"/>
      <text x="${b.x + 76}" y="${b.nut + 4}">nut</text><text x="${b.x + 76}" y="${b.bridge + 4}">bridge</text><path class="scale" d="${path([[b.x, b.nut], [b.x, b.bridge]])}"/>`;
    // The bow: hair at its place on the string, a stick that bends away, the frog at the handle.
    text += `<path class="bowstick" d="M${frog} ${level - 16}Q${frog + 170} ${level - 5} ${frog + 340} ${level - 15}L${frog + 346} ${level}"/><path class="bowhair" d="${path([[frog, level], [frog + 346, level]])}"/>
      <path class="handline" d="${path([handle, [frog, level]])}"/><rect class="knob" x="${frog - 9}" y="${level - 20}" width="26" height="24" rx="3"/>`;
    text += `<path class="string" d="${path(string)}"/>`;
    text += `<path class="scale" d="${path(Array.from({ length: 31 }, (_, i) => turn(-0.9 + 0.06 * i)))}"/><path class="lever" d="${path([b.lever, handle])}"/>${circle("hub", b.lever, 12)}${circle("knob", handle, 10)}`;
    text += hand_ring(handle, hand, 16) + force_at(handle, s.theta, newton, 60, 110);
    text += `<text x="10" y="20">the string in slow motion,</text><text x="10" y="35">its way ${b.wide} times as large</text>`;
    this.svg.innerHTML = text;
    const j = this.judged, kind = !j.count ? "no slips" : j.helmholtz ? "one slip a period: Helmholtz motion" : j.one ? "one slip a period, but a faint wave" : "not one slip a period";
    const ms = (x) => fixed(1000 * x, 2), pitch = j.count ? `, ${ms(j.least)} to ${ms(j.most)} ms apart: ${fixed(1 / j.mean, 1)} Hz, ${fixed(PERIOD_S / j.mean, 2)} in 1/196 s` : "";
    this.caption.textContent = `τ = −reach · friction = ${fixed(s.mean_torque)} Nm in the mean; the bow at ${fixed(REACH_M * s.speed, 2)} m/s\n${kind}${pitch}\nthe law's words at ${fixed(s.rate_hz / 1000, 0)} kHz`;
  }

  /** 25 ms of what comes to the bridge, from a slip on, so that an even tone stands still. */
  draw_heard() {
    const paper = cleared($("string-heard")), { pen, width, height, colour } = paper, { trace, seen } = this, dt = 1 / seen.rate_hz;
    const slip = this.slip_before(DRAWN_S), from = slip ? slip.time : seen.time - DRAWN_S, saw = this.bow_speed() / this.place / 2;
    const peak = trace.reduce((most, v) => Math.max(most, Math.abs(v)), Math.min(4, saw)), most = Math.max(0.5, Math.ceil(2.2 * peak) / 2);
    const left = 46, right = width - 10, top = 26, bottom = height - 18;
    const title = "what comes to the bridge, m/s, over 25 ms; dashed: ± speed / place / 2, a Helmholtz sawtooth's ends; below: slips";
    const x = (t) => left + ((t - from) / DRAWN_S) * (right - left), y = draw_scale(paper, title, [-most, 0, most], top, bottom, 15, 1);
    const line = (points) => draw_line(pen, points);
    pen.setLineDash([5, 5]);
    pen.strokeStyle = colour("--object");
    for (const v of [-saw, saw]) if (saw < most) line([[left, y(v)], [right, y(v)]]);
    pen.setLineDash([]);
    pen.strokeStyle = colour("--red");
    for (const { time } of this.slips) if (time >= from && time <= from + DRAWN_S) line([[x(time), bottom + 2], [x(time), bottom + 14]]);
    pen.strokeStyle = colour("--blue");
    pen.lineWidth = 1.5;
    const start = seen.time - trace.length * dt, points = [];
    trace.forEach((v, i) => {
      const t = start + i * dt;
      if (t < from - 1e-9 || t > from + DRAWN_S) return;
      if (seen.rate_hz < LAW_HZ && points.length) points.push([x(t), points[points.length - 1][1]]); // held
      points.push([x(t), y(v)]);
    });
    line(points);
    pen.lineWidth = 1;
  }

  bow_speed() {
    return this.alone ? this.speed : this.quick;
  }

  /** Force over place, both as ratios, with Schelleng's limits at the bow's speed. */
  draw_forces() {
    const { pen, width, height, colour } = cleared($("string-forces")), left = 34, right = width - 10, top = 24, bottom = height - 22;
    const bow = Math.max(0.02, this.bow_speed()), [low, high, near, far] = [0.03, 4, 0.05, 0.25];
    const x = (place) => left + (Math.log(place / near) / Math.log(far / near)) * (right - left);
    const y = (force) => bottom - (Math.log(Math.max(low, Math.min(high, force)) / low) / Math.log(high / low)) * (bottom - top);
    const places = Array.from({ length: 41 }, (_, i) => near * (far / near) ** (i / 40)), limits = places.map((place) => schelleng(bow, place));
    pen.fillStyle = colour("--green");
    pen.globalAlpha = 0.22;
    pen.beginPath();
    places.forEach((place, i) => pen.lineTo(x(place), y(limits[i][1])));
    [...places.keys()].reverse().forEach((i) => pen.lineTo(x(places[i]), y(limits[i][0])));
    pen.fill();
    pen.globalAlpha = 1;
    pen.fillStyle = colour("--faint");
    pen.strokeStyle = colour("--line");
    pen.strokeRect(left, top, right - left, bottom - top);
    pen.fillText(`force, N, over place; green: Schelleng's, ${fixed(bow, 2)} m/s`, 6, 14);
    for (const force of [0.1, 0.3, 1, 3]) { pen.fillText(String(force), 6, y(force) + 4); draw_line(pen, [[left, y(force)], [right, y(force)]]); }
    for (const over of [20, 13, 10, 7, 5, 4]) pen.fillText(`1/${over}`, Math.min(x(1 / over) - 8, right - 16), bottom + 14);
    pen.fillStyle = colour(this.judged.helmholtz ? "--green" : "--red");
    pen.beginPath();
    pen.arc(x(this.place), y(this.force), 6, 0, 2 * Math.PI);
    pen.fill();
  }
}
