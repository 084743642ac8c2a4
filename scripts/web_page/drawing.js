// What drawings share: where the mouse is in one, a canvas as sharp as the screen.
"use strict";

/** Where an event is, in the units of the picture's view box, which stands in the middle of its element. */
function pointed(event, svg) {
  const box = svg.getBoundingClientRect(), { width, height } = svg.viewBox.baseVal, size = Math.min(box.width / width, box.height / height);
  return [(event.clientX - box.left - (box.width - width * size) / 2) / size, (event.clientY - box.top - (box.height - height * size) / 2) / size];
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
  const { pen, width, height, colour } = cleared(canvas), left = 46, top = 24, bottom = height - 8;
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
    pen.fillText(line.text, left + 190 + 130 * n, 15);
    pen.beginPath();
    line.values.forEach((value, i) => (i ? pen.lineTo(x(i), y(value)) : pen.moveTo(x(i), y(value))));
    pen.stroke();
  });
}
