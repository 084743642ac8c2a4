// What the tabs share: pictures that mouse and keys lead, sliders, sounds, a canvas as sharp as the screen, curves over time.
"use strict";

/** Lets a picture be led: point(event) where the mouse is, or only while it is down; `steps` of keys go to step(). */
function led_by(svg, { point, dragged, down, up, steps = {}, step, space }) {
  svg.addEventListener("pointerdown", (event) => {
    svg.setPointerCapture(event.pointerId);
    if (down) down(event);
    point(event);
  });
  svg.addEventListener("pointermove", (event) => { if (!dragged || svg.hasPointerCapture(event.pointerId)) point(event); });
  for (const end of ["pointerup", "pointercancel"]) svg.addEventListener(end, () => up && up());
  svg.addEventListener("keydown", (event) => {
    if (event.key === " " && space) space();
    else if (event.key in steps) step(steps[event.key], event);
    else return;
    event.preventDefault();
  });
}

/** How something is led that a hand takes and lets go: by take(), aim() and held. */
const taken = (it, steps, point) => ({
  point, steps, dragged: true, down: () => it.take(true), up: () => it.take(false), space: () => it.take(!it.held),
  step: (rad) => { it.take(true); it.aim(it.lead + rad); },
});

/** Such a picture with a text below it, in an element. */
function make_stage(place, view, label, leads, role = 'role="application"') {
  place.innerHTML = `<svg viewBox="${view}" tabindex="0" ${role} aria-label="${label}"></svg><figcaption><div class="equation"></div></figcaption>`;
  const svg = place.querySelector("svg");
  led_by(svg, leads);
  return { svg, caption: place.querySelector(".equation") };
}

/** The picture of a lever without a core, whose hand the mouse wants at an angle: aim(rad); step(rad) by an arrow key. */
function lever_stage(place, name, label, most, { aim, step, dragged }) {
  const figure = document.createElement("figure"), steps = { ArrowLeft: -0.02, ArrowRight: 0.02 };
  const point = (event) => { const [x, y] = pointed(event, made.svg); aim(Math.atan2(x - CENTRE[0], Math.max(CENTRE[1] - y, 1))); };
  const made = make_stage(figure, "0 0 500 400", `${label}: the hand's angle in rad`, { point, dragged, steps, step }, `role="slider" aria-valuemin="${-most}" aria-valuemax="${most}" aria-valuenow="0"`);
  made.name = Object.assign(document.createElement("span"), { className: "name", textContent: name });
  made.caption.before(made.name);
  place.append(figure);
  return made;
}

/** A slider of the document: turned(value) hears what it says, now and at each change, and tell(value) shows it. */
function wire_slider(id, tell, turned) {
  $(id).oninput = () => {
    const value = Number($(id).value);
    $(`${id}-shown`).textContent = tell(value);
    turned(value);
  };
  $(id).oninput();
}

const press = (id, pressed, text) => { $(id).setAttribute("aria-pressed", pressed); if (text) $(id).textContent = text; };

/** Appends, and keeps the last `most`. */
const keep = (list, most, item) => { list.push(item); if (list.length > most) list.shift(); };

/** A button that lets a tab be heard, or not. */
function sound_button(id, is_heard, hear) {
  $(id).onclick = () => {
    const wanted = !is_heard();
    hear(wanted);
    press(id, wanted, wanted ? "Sound off" : "Sound on");
  };
}

/** A row of a table, with these texts. */
function add_row(table, texts, place = -1) {
  const row = table.insertRow(place);
  texts.forEach((text) => (row.insertCell().textContent = text));
  return row;
}

/** Plays samples, at once or at a time of the audio. */
function play(audio, samples, when = 0) {
  const buffer = audio.createBuffer(1, samples.length, audio.sampleRate), source = audio.createBufferSource();
  buffer.copyToChannel(samples, 0);
  source.buffer = buffer;
  source.connect(audio.destination);
  source.start(when);
}

/** Where an event is, in the units of the picture's view box, which stands in the middle of its element. */
function pointed(event, svg) {
  const box = svg.getBoundingClientRect(), { x, y, width, height } = svg.viewBox.baseVal, size = Math.min(box.width / width, box.height / height);
  return [x + (event.clientX - box.left - (box.width - width * size) / 2) / size, y + (event.clientY - box.top - (box.height - height * size) / 2) / size];
}

/** The page's colours by name. */
function colours() {
  const style = getComputedStyle(document.documentElement);
  return (name) => style.getPropertyValue(name).trim();
}

/** An empty canvas: its pen, its size, and the page's colours by name. */
function cleared(canvas) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  pen.font = "11px system-ui";
  return { pen, width, height, colour: colours() };
}

/** An arrow of SVG from a point along (u, v) of its own length; nothing where that is short. */
function arrow([x, y], u, v, kind) {
  const long = Math.hypot(u, v);
  if (long < 4) return "";
  const back = Math.min(9, long), ux = u / long, uy = v / long;
  const to = (along, across) => [x + along * ux - across * uy, y + along * uy + across * ux];
  return `<path class="${kind}" d="${path([[x, y], to(long - back, 0)])}"/><path class="${kind}head" d="${path([to(long, 0), to(long - back, 5.5), to(long - back, -5.5)])}Z"/>`;
}

/** Where a hand wants to be, and the way there. */
const hand_ring = (from, to, radius) => `<path class="handline" d="${path([from, to])}"/>${circle("handring", to, radius)}`;

/** Motor and bar, the hand that holds it, and the force at its ball. */
function held_bar(theta, hand, newton) {
  const ball = at(theta, LENGTH);
  return motor_and_bar(theta) + (hand === undefined ? "" : hand_ring(ball, at(hand, LENGTH), 19)) + force_at(ball, theta, newton, 18, 90);
}

/** Arrow of a torque at a lever's handle, as the force across it. */
function force_at(handle, theta, newton, per_newton, most) {
  const reach = Math.max(-most, Math.min(most, newton * per_newton));
  return arrow(handle, reach * Math.cos(theta), reach * Math.sin(theta), "force");
}

/** A line through points. */
function draw_line(pen, points) {
  pen.beginPath();
  points.forEach(([x, y], n) => (n ? pen.lineTo(x, y) : pen.moveTo(x, y)));
  pen.stroke();
}

/** A plot's title, and its lines at values with these texts; returns where a value is between top and bottom. */
function draw_scale({ pen, width, colour }, title, values, top, bottom, title_y = 15, digits = 2) {
  const low = Math.min(...values), high = Math.max(...values), y = (value) => bottom - ((value - low) / (high - low)) * (bottom - top);
  pen.strokeStyle = colour("--line");
  pen.fillStyle = colour("--faint");
  pen.fillText(title, 52, title_y);
  for (const value of values) {
    draw_line(pen, [[46, y(value)], [width - 8, y(value)]]);
    pen.fillText(value.toFixed(Math.abs(value) >= 10 ? 0 : digits), 4, y(value) + 4);
  }
  return y;
}

/** Curves about 0 in a canvas: lines of {text, colour, values}, of which `kept` values fill the width. */
function draw_traces(canvas, title, lines, kept, least) {
  const paper = cleared(canvas), { pen, width, height, colour } = paper, left = 46;
  // The key follows the title, and goes on in a second row where the canvas is narrow.
  let at = left + 6 + pen.measureText(title).width + 16, row = 0;
  const keys = lines.map(({ text }) => {
    const wide = pen.measureText(text).width + 16;
    if (row === 0 && at + wide > width) [at, row] = [left + 6, 1];
    at += wide;
    return { x: at - wide, y: 15 + 15 * row };
  });
  const most = Math.max(least, ...lines.flatMap((line) => line.values.map(Math.abs)));
  const x = (n) => left + (n / kept) * (width - left - 8), y = draw_scale(paper, title, [-most, 0, most], 24 + 15 * row, height - 8);
  lines.forEach((line, n) => {
    pen.strokeStyle = pen.fillStyle = colour(line.colour);
    pen.fillText(line.text, keys[n].x, keys[n].y);
    pen.setLineDash(line.dash ? [4, 3] : []);
    draw_line(pen, line.values.map((value, i) => [x(i), y(value)]));
    pen.setLineDash([]);
  });
}

const PANELS = [
  { id: "angle", title: "angle, rad, the last 4 s", least: 0.2, lines: [["theta", "--ink", "lever"], ["hand", "--hand", "hand"]] },
  { id: "torque", title: "torque, Nm", least: 0.05, lines: [["torque", "--blue", "motor"], ["tau_ref", "--ink", "asked"], ["tau_hat", "--red", "observed"]] },
  { id: "difference", title: "observed torque: fixed − double, µNm", least: 10, lines: [["difference", "--green", "fixed − double"]] },
];

/** The curves of the levers; those of the second are dashed. */
function draw_curves(devices) {
  if (!$(PANELS[0].id).clientWidth) return; // folded away
  for (const { id, title, least, lines } of PANELS) {
    const traces = devices.flatMap((d, n) => lines.map(([name, colour, text]) => ({ text: devices.length > 1 ? `${text} (${d.name})` : text, colour, values: d.traces[name], dash: n > 0 })));
    draw_traces($(id), title, traces, CURVES.kept, least);
  }
}
