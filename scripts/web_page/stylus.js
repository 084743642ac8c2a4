// A stylus on three slides: the mouse leads its hand in a section, a host sends the nearest plane.
"use strict";

const STYLUS_CUT = { width: 640, height: 430, x: 240, y: 220, per_m: 4000, right: 480 };
const STYLUS_ABOVE = { x: 560, y: 96, half: 72, per_m: 1200 }; // the view from above, beside the section
const STYLUS_MOST_M = 0.054; // where the hand may be led
const STYLUS_NEWTON = 55; // length of a force's arrow for 1 N
const STYLUS_TRACE = { sample_s: 0.001, samples: 1000 }; // what the curve keeps: 1 s

const in_section = ([x, , z]) => [STYLUS_CUT.x + STYLUS_CUT.per_m * x, STYLUS_CUT.y - STYLUS_CUT.per_m * z];
const from_above = ([x, y]) => [STYLUS_ABOVE.x + STYLUS_ABOVE.per_m * x, STYLUS_ABOVE.y - STYLUS_ABOVE.per_m * y];
const vector_plus = (a, b, k = 1) => a.map((v, n) => v + k * b[n]);

class StylusTab {
  constructor(core, numbers) {
    this.most_n = core.STYLUS_MOST_N;
    this.pen = new core.Stylus(numbers.stylus.image, numbers.stylus.image_of_edges, numbers.stylus.slides);
    this.worlds = numbers.stylus.worlds;
    this.seen = this.pen.state();
    this.trace = [];
    const steps = { ArrowLeft: [-1, 0, 0], ArrowRight: [1, 0, 0], ArrowUp: [0, 0, 1], ArrowDown: [0, 0, -1], PageUp: [0, 1, 0], PageDown: [0, -1, 0] };
    const step = ([x, y, z], event) => this.aim(...vector_plus(this.lead, event.shiftKey && z ? [0, z, 0] : [x, y, z], 0.001));
    Object.assign(this, make_stage($("stylus-stage"), `0 0 ${STYLUS_CUT.width} ${STYLUS_CUT.height}`,
      "Stylus: the hand follows the mouse, or the arrow keys by a millimetre; Page Up and Page Down lead it away and near", { point: (event) => this.point(event), steps, step }));
    for (const { name } of this.worlds) $("stylus-world").append(option(name, { floor: "plane" }[name] || name));
    $("stylus-world").append(option("mesh", "mesh: the knob, or a GLB file"));
    this.view = new MeshView($("stylus-view"));
    this.mesh = null; // {name, triangles, faces, ...} of the one that is loaded
    $("stylus-world").value = "sphere";
    $("stylus-file").onchange = () => $("stylus-file").files[0] && this.open($("stylus-file").files[0]);
    $("stylus-shading").oninput = () => this.shade();
    $("stylus-edges").oninput = () => this.touch();
    $("stylus-world").oninput = () => this.choose();
    this.choose();
    $("stylus-rate").oninput = () => this.touch();
    for (const [id, digits, unit] of [["stiffness", 0, " N/m"], ["damping", 2, " Ns/m"], ["friction", 2, ""], ["age", 1, " ms"]]) {
      wire_slider(`stylus-${id}`, (value) => fixed(value, digits) + unit, () => this.touch());
    }
    wire_slider("stylus-y", (mm) => `${fixed(mm, 0)} mm`, (mm) => this.aim(this.lead[0], mm / 1000, this.lead[2]));
  }

  /** Another object, with the pen above it. */
  choose() {
    const name = $("stylus-world").value, meshed = name === "mesh";
    if (meshed && !this.mesh) this.load("", new Uint8Array());
    if (!meshed) { this.pen.unload(); this.mesh = null; }
    this.world = meshed ? { name, kind: 0, centre: [0, 0, 0], radius_m: 0 } : this.worlds.find((world) => world.name === name);
    $("stylus-mesh").hidden = $("stylus-view").hidden = !meshed;
    if (meshed) this.shade();
    this.touch();
    this.pen.place(0, 0, 0.045);
    this.led = [0, 0, 0.045];
    this.aim(...this.led);
    this.seen = this.pen.state();
  }

  /** A GLB file to feel; where it cannot be, the importer says why, and all stays as it was. */
  async open(file) {
    if (!this.load(file.name, new Uint8Array(await file.arrayBuffer()))) return;
    $("stylus-world").value = "mesh";
    this.choose();
  }

  /** Without a name, the knob. */
  load(name, bytes) {
    const found = this.pen.load(name, bytes, MESH_SIZE_M);
    $("stylus-said").textContent = found.error;
    if (found.error) return false;
    this.mesh = { name: name || "the knob", ...found, triangles: this.pen.triangles() };
    const { faces, read, scale, parts, borders, nonmanifold, genus } = this.mesh, closed = borders ? `${borders} edges at a border` : "closed";
    const many = nonmanifold ? `, ${nonmanifold} edges of more than two faces` : "";
    $("stylus-said").textContent = `${this.mesh.name}: ${faces} of ${read} triangles, scaled by ${Number(scale.toPrecision(3))} to ${1000 * MESH_SIZE_M} mm; ` +
      `${parts} part${parts === 1 ? "" : "s"}, ${closed}${many}${genus === null ? "" : `, genus ${genus}`}`;
    return true;
  }

  shade() {
    const smooth = $("stylus-shading").checked;
    this.pen.shade(smooth);
    if (this.mesh) this.view.show(this.mesh.triangles, smooth);
  }

  /** The host begins anew, with what the controls say. */
  touch() {
    const number = (id) => Number($(`stylus-${id}`).value);
    this.material = { stiffness_n_m: number("stiffness"), damping_ns_m: number("damping"), friction: number("friction") };
    const edged = ["mesh", "cube"].includes(this.world.name);
    $("stylus-edged").hidden = !edged;
    this.pen.tellEdges(edged && $("stylus-edges").checked);
    this.seen = this.pen.state();
    this.rate_hz = number("rate") || this.seen.rate_hz;
    this.pen.touch({ ...this.world, ...this.material, rate_hz: this.rate_hz, age_s: number("age") / 1000 });
  }

  /** The section leads x and z; the view from above, while it is pressed, x and y. */
  point(event) {
    const [x, y] = pointed(event, this.svg);
    if (event.type === "pointerdown") this.above = x > STYLUS_CUT.right;
    if (!event.buttons) this.above = false;
    if (this.above) this.aim((x - STYLUS_ABOVE.x) / STYLUS_ABOVE.per_m, (STYLUS_ABOVE.y - y) / STYLUS_ABOVE.per_m, this.lead[2]);
    else if (x <= STYLUS_CUT.right) this.aim((x - STYLUS_CUT.x) / STYLUS_CUT.per_m, this.lead[1], (STYLUS_CUT.y - y) / STYLUS_CUT.per_m);
  }

  aim(...lead) {
    this.lead = lead.map((m) => Math.max(-STYLUS_MOST_M, Math.min(STYLUS_MOST_M, m)));
    $("stylus-y").value = 1000 * this.lead[1];
    $("stylus-y-shown").textContent = `${fixed(1000 * this.lead[1], 0)} mm`;
  }

  /** In slices, so that a plane that comes is seen in the curve. */
  advance(seconds) {
    const slices = Math.max(1, Math.round(seconds / STYLUS_TRACE.sample_s)), from = this.led;
    for (let n = 1; n <= slices; ++n) {
      this.pen.lead(...vector_plus(from, vector_plus(this.lead, from, -1), n / slices));
      say(this.pen.advance(seconds / slices));
      this.seen = this.pen.state();
      keep(this.trace, STYLUS_TRACE.samples, [Math.hypot(...this.seen.force), (180 / Math.PI) * this.seen.tilt]);
    }
    this.led = this.lead;
  }

  frame(passed) {
    run_timed(passed, () => this.advance(passed));
    this.draw();
    if (this.mesh) this.view.draw(this.seen);
    this.draw_trace();
  }

  /** The object cut at the pen's y, and its outline where it is widest. */
  object_in_section() {
    const { name, centre, radius_m } = this.world, [x, y] = in_section(centre), r = STYLUS_CUT.per_m * radius_m;
    if (name === "mesh") {
      const cut = Math.round(1e4 * this.seen.pen[1]) / 1e4; // a new one each tenth of a millimetre
      if (this.mesh.cut !== cut) Object.assign(this.mesh, { cut, section: mesh_section(this.mesh.triangles, cut, in_section) });
      return `<path class="outline" d="${this.mesh.section}"/>`;
    }
    if (name === "floor") return `<path class="outline" d="${path([[-600, y], [STYLUS_CUT.right + 5, y], [STYLUS_CUT.right + 5, 500], [-600, 500]])}Z"/>`;
    const off = Math.abs(this.seen.pen[1] - centre[1]), inside = off < radius_m;
    if (name === "cube") {
      const square = (kind) => `<rect class="${kind}" x="${x - r}" y="${y - r}" width="${2 * r}" height="${2 * r}"/>`;
      return square("scale") + (inside ? square("outline") : "");
    }
    return circle("scale", [x, y], r) + (inside ? circle("outline", [x, y], STYLUS_CUT.per_m * Math.sqrt(radius_m ** 2 - off ** 2)) : "");
  }

  /** A plane, cut at the pen's y next to the pen, and its normal, beside the pen. */
  plane_in_section(point, normal) {
    const { pen } = this.seen;
    const above = vector_plus(pen, point, -1).reduce((sum, part, n) => sum + part * normal[n], 0);
    const flat = Math.hypot(normal[0], normal[2]);
    if (flat < 0.2) return `<text x="8" y="36">the sent plane lies along the cut: see from above</text>`;
    // From the pen within the section to the plane.
    const way = above / flat, [x, y] = in_section([pen[0] - (way * normal[0]) / flat, 0, pen[2] - (way * normal[2]) / flat]);
    const u = normal[2] / flat, v = normal[0] / flat;
    return `<path class="sent plane" d="${path([[x - 75 * u, y - 75 * v], [x + 75 * u, y + 75 * v]])}"/>` + arrow([x - 55 * u, y - 55 * v], 50 * normal[0], -50 * normal[2], "sent");
  }

  view_from_above() {
    const { name, centre, radius_m } = this.world, { pen, hand, force, point, normal } = this.seen;
    const [x, y] = from_above(centre), r = STYLUS_ABOVE.per_m * radius_m, left = STYLUS_ABOVE.x - STYLUS_ABOVE.half, top = STYLUS_ABOVE.y - STYLUS_ABOVE.half, size = 2 * STYLUS_ABOVE.half;
    const box = (kind, half_x, half_y) => `<rect class="${kind}" x="${x - half_x}" y="${y - half_y}" width="${2 * half_x}" height="${2 * half_y}"/>`;
    const object = name === "mesh" ? "" : name === "floor" ? box("outline", STYLUS_ABOVE.half, STYLUS_ABOVE.half) : name === "cube" ? box("outline", r, r) : circle("outline", [x, y], r);
    const at_pen = from_above(pen), at_hand = from_above(hand), scale = STYLUS_NEWTON * 0.4;
    return `<rect class="scale" x="${left}" y="${top}" width="${size}" height="${size}"/><g clip-path="url(#stylus-above)">${object}` +
      `<path class="scale" stroke-dasharray="4 4" d="${path([[left, at_pen[1]], [left + size, at_pen[1]]])}"/>` +
      (point ? arrow(at_pen, 30 * normal[0], -30 * normal[1], "sent") : "") + arrow(at_pen, scale * force[0], -scale * force[1], "force") +
      `${circle("handring", at_hand, 8)}${circle("knob", at_pen, 4)}</g>` +
      `<text x="${left}" y="${top - 7}">from above, y up</text>`;
  }

  draw() {
    const s = this.seen, tip = in_section(s.pen), hand = in_section(s.hand), lean = Math.PI / 6;
    const on_pen = (along, across) => [tip[0] + along * Math.sin(lean) + across * Math.cos(lean), tip[1] - along * Math.cos(lean) + across * Math.sin(lean)];
    const body = `<path class="joint" d="${path([tip, on_pen(18, 6), on_pen(120, 6), on_pen(120, -6), on_pen(18, -6)])}Z"/>`;
    const key = [["sent", "plane, as sent"], ["force", "force on the pen"], ["handline", "to where it is led"]].map(
      ([kind, text], n) => `<path class="${kind}" d="${path([[490, 196 + 20 * n], [506, 196 + 20 * n]])}"/><text x="511" y="${200 + 20 * n}">${text}</text>`).join("");
    const age = s.point ? `${fixed(1000 * s.age, s.age < 0.001 ? 2 : 1)} ms` : "none yet";
    const large = [["depth", `${fixed(1000 * Math.max(0, s.depth), 2)} mm`], ["force", `${fixed(Math.hypot(...s.force), 2)} N`], ["tilt", `${fixed((180 / Math.PI) * s.tilt, 2)}°`], ["age", age]].map(
      ([name, text], n) => `<text x="490" y="${288 + 36 * n}">${name}</text><text class="figure" x="628" y="${290 + 36 * n}">${text}</text>`).join("");
    this.svg.innerHTML = `<defs><clipPath id="stylus-cut"><rect x="-500" width="${STYLUS_CUT.right + 500}" height="${STYLUS_CUT.height}"/></clipPath>
      <clipPath id="stylus-above"><rect x="${STYLUS_ABOVE.x - STYLUS_ABOVE.half}" y="${STYLUS_ABOVE.y - STYLUS_ABOVE.half}" width="${2 * STYLUS_ABOVE.half}" height="${2 * STYLUS_ABOVE.half}"/></clipPath></defs>
      <g clip-path="url(#stylus-cut)">${this.object_in_section()}${body}${s.point ? this.plane_in_section(s.point, s.normal) : ""}${s.second ? this.plane_in_section(s.second_point, s.second) : ""}${s.proxy ? circle("proxy", in_section(s.proxy), 5) : ""}${hand_ring(tip, hand, 13)}${arrow(tip, STYLUS_NEWTON * s.force[0], -STYLUS_NEWTON * s.force[2], "force")}${circle("knob", tip, 4.5)}</g>
      <path class="scale" d="${path([[STYLUS_CUT.right, 0], [STYLUS_CUT.right, STYLUS_CUT.height]])}"/><text x="8" y="18">cut at y = ${fixed(1000 * s.pen[1], 1)} mm, z up</text>${this.view_from_above()}${key}${large}`;
    const list = (v, digits, k = 1) => `(${v.map((part) => fixed(k * part, digits)).join(", ")})`;
    this.caption.textContent = `pen ${list(s.pen, 1, 1000)} mm; F = ${list(s.force, 2)} N${s.limited ? `: an axis gives ${this.most_n} N, no more` : ""}\n` +
      (s.normal ? `n = ${list(s.normal, 3)} as sent, ${fixed(1000 * s.tilt, 1)} mrad off the true one; ` : "") + `the law's words at ${fixed(s.rate_hz / 1000, 0)} kHz`;
  }

  draw_trace() {
    const paper = cleared($("stylus-curve")), { pen, width, height, colour } = paper;
    const x = (n) => 46 + (n / STYLUS_TRACE.samples) * (width - 54);
    [["force on the pen, N, the last second", "--red", 1], ["sent normal off the true one, degrees", "--blue", 0.5]].forEach(([title, name, least], n) => {
      const top = 20 + (n * height) / 2, most = Math.max(least, ...this.trace.map((row) => row[n]));
      const y = draw_scale(paper, title, [0, most], top, ((n + 1) * height) / 2 - 6, top - 6);
      pen.strokeStyle = colour(name);
      draw_line(pen, this.trace.map((row, i) => [x(i), y(row[n])]));
    });
  }
}
