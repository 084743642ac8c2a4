// What drawings share: where the mouse is in one, a canvas as sharp as the screen, curves over time.
"use strict";

/** Where an event is, in the units of the picture's view box, which stands in the middle of its element. */
function pointed(event, svg) {
  const box = svg.getBoundingClientRect(), { x, y, width, height } = svg.viewBox.baseVal, size = Math.min(box.width / width, box.height / height);
  return [x + (event.clientX - box.left - (box.width - width * size) / 2) / size, y + (event.clientY - box.top - (box.height - height * size) / 2) / size];
}

/** An empty canvas: its pen, its size, and the page's colours by name. */
function cleared(canvas) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const style = getComputedStyle(document.documentElement), colour = (name) => style.getPropertyValue(name).trim();
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  pen.font = "11px system-ui";
  return { pen, width, height, colour };
}

/** An arrow of SVG from a point along (u, v) of its own length; nothing where that is short. */
function arrow([x, y], u, v, kind) {
  const long = Math.hypot(u, v);
  if (long < 4) return "";
  const back = Math.min(9, long), ux = u / long, uy = v / long;
  const to = (along, across) => [x + along * ux - across * uy, y + along * uy + across * ux];
  return `<path class="${kind}" d="${path([[x, y], to(long - back, 0)])}"/><path class="${kind}head" d="${path([to(long, 0), to(long - back, 5.5), to(long - back, -5.5)])}Z"/>`;
}

/** Arrow of a torque at a lever's handle, as the force across it. */
function force_at(handle, theta, newton, per_newton, most) {
  const reach = Math.max(-most, Math.min(most, newton * per_newton));
  return arrow(handle, reach * Math.cos(theta), reach * Math.sin(theta), "force");
}

/** Curves about 0 in a canvas: lines of {text, colour, values}, of which `kept` values fill the width. */
function draw_traces(canvas, title, lines, kept, least) {
  const { pen, width, height, colour } = cleared(canvas), left = 46, bottom = height - 8;
  // The key follows the title, and goes on in a second row where the canvas is narrow.
  let at = left + 6 + pen.measureText(title).width + 16, row = 0;
  const keys = lines.map(({ text }) => {
    const wide = pen.measureText(text).width + 16;
    if (row === 0 && at + wide > width) [at, row] = [left + 6, 1];
    at += wide;
    return { x: at - wide, y: 15 + 15 * row };
  });
  const top = 24 + 15 * row;
  const most = Math.max(least, ...lines.flatMap((line) => line.values.map(Math.abs)));
  const x = (n) => left + (n / kept) * (width - left - 8), y = (value) => (top + bottom) / 2 - (value / most) * ((bottom - top) / 2);
  pen.strokeStyle = colour("--line");
  pen.fillStyle = colour("--faint");
  pen.fillText(title, left + 6, 15);
  for (const value of [-most, 0, most]) {
    pen.beginPath(); pen.moveTo(left, y(value)); pen.lineTo(width - 8, y(value)); pen.stroke();
    pen.fillText(value.toFixed(2), 4, y(value) + 4);
  }
  lines.forEach((line, n) => {
    pen.strokeStyle = pen.fillStyle = colour(line.colour);
    pen.fillText(line.text, keys[n].x, keys[n].y);
    pen.beginPath();
    line.values.forEach((value, i) => (i ? pen.lineTo(x(i), y(value)) : pen.moveTo(x(i), y(value))));
    pen.stroke();
  });
}

// Live curves with a real time axis: the extremes of each pixel's samples, so that no spike is lost.
const SHOWN_S = 4;

const PANELS = [
  { id: "angle", title: "angle, rad", least: 0.2, lines: [["theta", "--ink", "lever"], ["hand", "--hand", "hand"]] },
  { id: "torque", title: "torque, Nm", least: 0.05, lines: [["torque", "--blue", "motor"], ["tau_ref", "--ink", "asked"], ["tau_hat", "--red", "observed"]] },
  { id: "difference", title: "observed torque: fixed − double, µNm", least: 10, lines: [["difference", "--green", "fixed − double"]] },
];

function draw_curves(devices) {
  if (!$(PANELS[0].id).clientWidth) return; // folded away
  for (const panel of PANELS) {
    const { pen, width, height, colour } = cleared(document.getElementById(panel.id));
    const now = Math.max(...devices.map((d) => d.now.time)), left = 46, bottom = height - 16, columns = Math.max(10, Math.floor(width - left - 6));
    const traces = devices.flatMap((d, n) => panel.lines.map(([name, tint, label]) => ({ ...extremes(d.history, name, now, columns), tint, label: devices.length > 1 ? `${label} (${d.name})` : label, dash: n > 0 })));
    let low = -panel.least, high = panel.least;
    for (const t of traces) {
      for (let i = 0; i < columns; ++i) {
        if (t.low[i] < low) low = t.low[i];
        if (t.high[i] > high) high = t.high[i];
      }
    }
    const top = 24, y = (v) => top + ((high - v) / (high - low)) * (bottom - top - 6);
    pen.strokeStyle = colour("--line");
    pen.fillStyle = colour("--faint");
    for (let s = Math.ceil(now - SHOWN_S); s <= now; ++s) {
      const x = left + ((s - now + SHOWN_S) / SHOWN_S) * columns;
      pen.beginPath(); pen.moveTo(x, top); pen.lineTo(x, bottom); pen.stroke();
      pen.fillText(`${s} s`, x + 2, height - 4);
    }
    for (const v of [low, 0, high]) {
      pen.beginPath(); pen.moveTo(left, y(v)); pen.lineTo(left + columns, y(v)); pen.stroke();
      pen.fillText(Math.abs(v) >= 10 ? v.toFixed(0) : v.toFixed(2), 4, Math.min(bottom - 2, y(v) + 9));
    }
    let x = left + 6;
    pen.fillText(panel.title, x, 15);
    x += pen.measureText(panel.title).width + 18;
    for (const t of traces) {
      pen.strokeStyle = pen.fillStyle = colour(t.tint);
      pen.fillText(t.label, x, 15);
      x += pen.measureText(t.label).width + 14;
      pen.setLineDash(t.dash ? [4, 3] : []);
      pen.beginPath();
      let drawing = false;
      for (let i = 0; i < columns; ++i) {
        if (t.low[i] > t.high[i]) { drawing = false; continue; }
        if (drawing) pen.lineTo(left + i, y(t.high[i])); else pen.moveTo(left + i, y(t.high[i]));
        pen.lineTo(left + i, y(t.low[i]));
        drawing = true;
      }
      pen.stroke();
      pen.setLineDash([]);
    }
  }
}

function extremes(history, name, now, columns) {
  const low = new Float32Array(columns).fill(Infinity), high = new Float32Array(columns).fill(-Infinity);
  const begin = (history.next - history.length + KEPT) % KEPT;
  for (let i = 0; i < history.length; ++i) {
    const n = (begin + i) % KEPT, column = Math.floor(((history.time[n] - now + SHOWN_S) / SHOWN_S) * columns);
    if (column < 0 || column >= columns) continue;
    const v = name === "difference" ? 1e6 * (history.tau_hat[n] - history.float_hat[n]) : history[name][n];
    if (v < low[column]) low[column] = v;
    if (v > high[column]) high[column] = v;
  }
  return { low, high };
}
