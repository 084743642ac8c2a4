// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The chart of explore.html: dots on axes that the reader chooses, and what a dot tells.
// Documentation: docs/explore.md
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const chart = document.getElementById("chart");
  const told = document.getElementById("told");
  const choice = (id) => document.getElementById(id);
  const edge = { left: 62, right: 14, top: 14, bottom: 44 };
  const width = 640, height = 460;
  let kept = null;

  function element(name, attributes, parent, text) {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    if (text !== undefined) made.textContent = text;
    parent.appendChild(made);
    return made;
  }

  const short = (v) => {
    if (Number.isInteger(v) && Math.abs(v) < 1e6) return String(v);
    const size = Math.abs(v);
    if (size >= 1e5 || size < 1e-3) return v.toExponential(1);
    return String(Number(v.toPrecision(3)));
  };

  // From a figure to a place; logarithmic where the values span more than a decade and a half.
  function scale(values, from, to) {
    let low = Math.min(...values), high = Math.max(...values);
    const log = low > 0 && high / low > 30;
    const of = log ? Math.log10 : (v) => v;
    let a = of(low), b = of(high);
    if (a === b) { a -= 0.5; b += 0.5; }
    const margin = 0.05 * (b - a);
    a -= margin; b += margin;
    const place = (v) => from + ((of(v) - a) / (b - a)) * (to - from);
    const ticks = [];
    if (log) {
      const steps = b - a > 2.5 ? [1] : [1, 2, 5];
      const inside = (v) => of(v) >= a && of(v) <= b;
      for (let e = Math.floor(a); e <= Math.ceil(b); e++)
        ticks.push(...steps.map((s) => s * 10 ** e).filter(inside));
    } else {
      const raw = (b - a) / 6, unit = 10 ** Math.floor(Math.log10(raw));
      const step = [1, 2, 5, 10].map((s) => s * unit).find((s) => s >= raw);
      for (let v = Math.ceil(a / step) * step; v <= b; v += step) ticks.push(v);
    }
    return { place, ticks };
  }

  const value = (dot, i) => (dot.y[i] === null ? null : dot.y[i] * data.figures[i].factor);
  const title = (f) => f.what + (f.unit ? ", " + f.unit : "");

  function draw() {
    chart.replaceChildren();
    const x = Number(choice("across").value), y = Number(choice("up").value);
    const dots = data.dots.filter((d) => value(d, x) !== null && value(d, y) !== null &&
      (d.front || !choice("only").checked));
    if (!dots.length) {
      element("text", { x: 80, y: 80 }, chart, "no point has both figures");
      return;
    }
    const across = scale(dots.map((d) => value(d, x)), edge.left, width - edge.right);
    const up = scale(dots.map((d) => value(d, y)), height - edge.bottom, edge.top);
    for (const t of across.ticks) {
      const at = across.place(t);
      element("line", { x1: at, x2: at, y1: edge.top, y2: height - edge.bottom }, chart);
      const below = { x: at, y: height - edge.bottom + 16, "text-anchor": "middle" };
      element("text", below, chart, short(t));
    }
    for (const t of up.ticks) {
      const at = up.place(t);
      element("line", { x1: edge.left, x2: width - edge.right, y1: at, y2: at }, chart);
      element("text", { x: edge.left - 6, y: at + 4, "text-anchor": "end" }, chart, short(t));
    }
    const middle = { "text-anchor": "middle", class: "label" };
    element("text", { x: (edge.left + width) / 2, y: height - 8, ...middle }, chart,
      title(data.figures[x]));
    element("text", { x: 14, y: height / 2, transform: `rotate(-90 14 ${height / 2})`, ...middle },
      chart, title(data.figures[y]));
    // The front last, so that it lies on top.
    dots.sort((a, b) => Boolean(a.preset) - Boolean(b.preset) || a.front - b.front);
    for (const dot of dots) {
      const cx = across.place(value(dot, x)), cy = up.place(value(dot, y));
      const kind = dot.preset ? "preset" : dot.front ? "front" : "";
      const circle = element("circle", { cx, cy, r: dot.preset ? 7 : dot.front ? 5 : 4, class: kind,
        tabindex: 0, "aria-label": dot.preset || dot.what }, chart);
      circle.addEventListener("mouseenter", () => kept || tell(dot, circle));
      circle.addEventListener("focus", () => kept || tell(dot, circle));
      circle.addEventListener("click", (event) => {
        event.stopPropagation();
        kept = dot;
        tell(dot, circle);
      });
      if (kept === dot) circle.classList.add("shown");
      if (dot.preset) element("text", { x: cx + 10, y: cy - 8, class: "name" }, chart, dot.preset);
    }
  }

  // The base's lines with this point's changes; [text, whether it is changed].
  function design(dot) {
    const lines = data.bases[dot.base].split("\n").map((line) => [line, false]);
    for (const [first, away, instead] of [...dot.text].reverse())
      lines.splice(first, away, ...instead.map((line) => [line, true]));
    return lines;
  }

  function html(name, text, parent) {
    const made = document.createElement(name);
    if (text) made.textContent = text;
    parent.appendChild(made);
    return made;
  }

  function tell(dot, circle) {
    chart.querySelectorAll(".shown").forEach((c) => c.classList.remove("shown"));
    circle.classList.add("shown");
    told.replaceChildren();
    html("h3", dot.preset || (dot.front ? "on the front" : "not on the front"), told);
    html("p", dot.what, told);
    const table = html("table", "", told);
    data.figures.forEach((figure, i) => {
      if (dot.y[i] === null) return;
      const row = html("tr", "", table);
      html("td", title(figure), row);
      html("td", short(value(dot, i)), row);
    });
    const lines = design(dot);
    const text = lines.map(([line]) => line).join("\n");
    const link = html("a", `design file ${dot.preset || dot.id}.toml`, html("p", "", told));
    link.href = "data:text/plain;charset=utf-8," + encodeURIComponent(text);
    link.download = `${dot.preset || dot.id}.toml`;
    const pre = html("pre", "", told);
    for (const [line, changed] of lines) {
      if (changed) html("mark", line, pre);
      else pre.append(line);
      pre.append("\n");
    }
  }

  choice("across").value = 0;
  choice("up").value = 1;
  for (const id of ["across", "up", "only"]) choice(id).addEventListener("change", draw);
  addEventListener("click", (event) => { if (!told.contains(event.target)) kept = null; });
  told.textContent = "Hover a dot.";
  draw();
})();
