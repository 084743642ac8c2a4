// Live curves with a real time axis: the extremes of each pixel's samples, so that no spike is lost.
"use strict";

const SHOWN_S = 4;

const PANELS = [
  { id: "angle", title: "angle, rad", least: 0.2, lines: [["theta", "--ink", "lever"], ["hand", "--hand", "hand"]] },
  { id: "torque", title: "torque, Nm", least: 0.05, lines: [["torque", "--blue", "motor"], ["tau_ref", "--ink", "asked"], ["tau_hat", "--red", "observed"]] },
  { id: "difference", title: "observed torque: fixed − double, µNm", least: 10, lines: [["difference", "--green", "fixed − double"]] },
];

function draw_curves(devices) {
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
