// A law that the user writes: the text with its errors, the table, and its torque over a turn.
"use strict";

const LAW_DESIGN = "lever_law"; // which has an engine
const PAUSE_MS = 400; // of typing, before the law is compiled
const TURN_POINTS = 1441;

SCENES.law = { title: "a law of yours", begin: "Write how the force goes, take the ball and feel it.", sliders: [], law: (v, s) => `τ = f(θ, ω), your law: ${fixed(s.tau_ref)} Nm at ${fixed(s.theta)} rad, ${fixed(s.omega, 2)} rad/s` };

const law_sliders = (parameters) => parameters.map((p) => ({ ...p, name: `law:${p.name}`, law: p.name, label: p.name }));

class LawEditor {
  /** `changed(text)` is called with a law that compiles. */
  constructor(laws, text, worker, changed) {
    this.laws = laws;
    this.worker = worker;
    this.changed = changed;
    this.text = $("law-text");
    this.asked = 0;
    for (const name of Object.keys(laws)) $("shipped").append(option(name, name));
    $("shipped").append(option("", "your own"));
    $("shipped").oninput = () => { if ($("shipped").value) this.show(laws[$("shipped").value]); };
    this.text.oninput = () => {
      $("shipped").value = Object.keys(laws).find((name) => laws[name] === this.text.value) || "";
      this.point();
      clearTimeout(this.waiting);
      this.waiting = setTimeout(() => this.check(), PAUSE_MS);
    };
    this.text.onscroll = () => this.point();
    $("shipped").value = Object.keys(laws).find((name) => laws[name] === text) || "";
    this.text.value = text;
  }

  show(text) {
    this.text.value = text;
    this.text.scrollTop = 0;
    clearTimeout(this.waiting);
    return this.check();
  }

  async check() {
    const text = this.text.value, asked = ++this.asked, begin = performance.now();
    const answer = await this.worker.call("checkLaw", LAW_DESIGN, text);
    if (asked !== this.asked) return; // there is a newer one
    this.seconds = (performance.now() - begin) / 1000;
    this.errors = answer.failed ? [{ line: 1, column: 1, what: answer.failed, mend: "" }] : answer.errors;
    this.point();
    if (this.errors.length) {
      $("law-said").textContent = `${this.errors.length === 1 ? "1 error" : `${this.errors.length} errors`}; the lever still feels the law before.`;
      return;
    }
    $("law-said").textContent = `compiled in ${fixed(this.seconds, 1)} s`;
    $("law-table").textContent = answer.report;
    this.changed(text);
  }

  /** The first error in words below the text, and a line under its place, which covers nothing. */
  point() {
    const mark = $("law-mark"), first = (this.errors || [])[0];
    $("law-error").hidden = mark.hidden = !first;
    if (!first) return;
    $("law-error").textContent = `${first.line}:${first.column}: ${first.what}${first.mend ? `; ${first.mend}` : ""}`;
    const style = getComputedStyle(this.text), line = parseFloat(style.lineHeight), inset = parseFloat(style.paddingTop);
    const word = (this.text.value.split("\n")[first.line - 1] || "").slice(first.column - 1).match(/^[A-Za-z0-9_]+/);
    mark.style.top = `${inset + first.line * line - this.text.scrollTop - 2}px`;
    mark.style.left = `calc(${inset - this.text.scrollLeft}px + ${first.column - 1}ch)`;
    mark.style.width = `${word ? word[0].length : 1}ch`;
  }
}

/** Torque against position over a turn, up and back, as the words of the program say it, and where the lever is. */
function draw_turn(device) {
  const paper = cleared($("turn")), { pen, width, height, colour } = paper;
  if (!width) return;
  device.turn ??= device.loop.lawCurve(TURN_POINTS);
  const left = 46, right = width - 8, top = 24, bottom = height - 18;
  const most = Math.max(0.01, Math.abs(device.now.tau_ref), ...device.turn.map(Math.abs));
  const x = (rad) => left + ((rad + Math.PI) / (2 * Math.PI)) * (right - left);
  const up = device.turn.slice(0, TURN_POINTS), back = device.turn.slice(TURN_POINTS).reverse();
  const loop = up.some((nm, n) => Math.abs(nm - back[n]) >= most / 100);
  const y = draw_scale(paper, `torque over a turn at rest, Nm${loop ? "; green: on the way back" : ""}`, [-most, 0, most], top, bottom);
  for (const rad of [-3, -2, -1, 0, 1, 2, 3]) {
    draw_line(pen, [[x(rad), top], [x(rad), bottom]]);
    pen.fillText(rad === 0 ? "0 rad" : `${fixed(rad, 0)}`, x(rad) - 4, height - 5);
  }
  const x_of = (n) => x(-Math.PI + (2 * Math.PI * n) / (TURN_POINTS - 1));
  pen.lineWidth = 1.5;
  for (const [way, name] of loop ? [[back, "--green"], [up, "--blue"]] : [[up, "--blue"]]) {
    pen.strokeStyle = colour(name);
    draw_line(pen, way.map((nm, n) => [x_of(n), y(nm)]));
  }
  pen.lineWidth = 1;
  pen.strokeStyle = pen.fillStyle = colour("--red");
  const theta = Math.atan2(Math.sin(device.now.theta), Math.cos(device.now.theta));
  draw_line(pen, [[x(theta), top], [x(theta), bottom]]);
  pen.beginPath(); pen.arc(x(theta), y(device.now.tau_ref), 4, 0, 7); pen.fill();
}
