// A mesh under the stylus: a GLB file that is dropped or chosen, or the built-in knob; and its picture, which can be turned.
"use strict";

const MESH_SIZE_M = 0.06;
const MESH_VIEW = { width: 640, height: 400, per_m: 4400, floats: 18 }; // floats of a triangle: three corners, three normals

/** The picture, without WebGL: each triangle into a buffer of depths, once for each turn; pen, proxy and force over it. */
class MeshView {
  constructor(canvas) {
    this.canvas = canvas;
    canvas.width = MESH_VIEW.width;
    canvas.height = MESH_VIEW.height;
    this.turn = [0.4, 0.5]; // about the vertical, and from above; rad
    canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
      if (!event.buttons) return;
      this.turn = [this.turn[0] - event.movementX / 150, Math.max(-1.5, Math.min(1.5, this.turn[1] + event.movementY / 150))];
      this.image = null;
    });
  }

  show(triangles, smooth) {
    Object.assign(this, { triangles, smooth, image: null });
  }

  /** Right, up and towards the eye, in the device's frame. */
  axes() {
    const [a, b] = this.turn, [ca, sa, cb, sb] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b)];
    return [[ca, sa, 0], [-sa * sb, ca * sb, cb], [sa * cb, -ca * cb, sb]];
  }

  paint() {
    const { width, height, per_m, floats } = MESH_VIEW, t = this.triangles, [right, up, out] = this.axes();
    const image = new ImageData(width, height), depth = new Float32Array(width * height).fill(-Infinity);
    const along = (axis, n) => axis[0] * t[n] + axis[1] * t[n + 1] + axis[2] * t[n + 2];
    const at = new Float64Array(9), light = new Float64Array(3), lamp = vector_plus(vector_plus(out, up, 0.5), right, -0.4), bright = Math.hypot(...lamp);
    for (let n = 0; n < t.length; n += floats) {
      for (let k = 0; k < 3; ++k) {
        at[3 * k] = width / 2 + per_m * along(right, n + 3 * k);
        at[3 * k + 1] = height / 2 - per_m * along(up, n + 3 * k);
        at[3 * k + 2] = per_m * along(out, n + 3 * k);
      }
      const [x0, y0, z0, x1, y1, z1, x2, y2, z2] = at, area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0);
      if (Math.abs(area) < 1e-9) continue;
      if (this.smooth) for (let k = 0; k < 3; ++k) light[k] = Math.abs(along(lamp, n + 9 + 3 * k)) / bright;
      else {
        const a = [t[n + 3] - t[n], t[n + 4] - t[n + 1], t[n + 5] - t[n + 2]], b = [t[n + 6] - t[n], t[n + 7] - t[n + 1], t[n + 8] - t[n + 2]];
        const normal = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        light.fill(Math.abs(normal.reduce((sum, part, i) => sum + part * lamp[i], 0)) / (Math.hypot(...normal) * bright));
      }
      const low = Math.max(0, Math.ceil(Math.min(y0, y1, y2))), high = Math.min(height - 1, Math.floor(Math.max(y0, y1, y2)));
      const left = Math.max(0, Math.ceil(Math.min(x0, x1, x2))), last = Math.min(width - 1, Math.floor(Math.max(x0, x1, x2)));
      for (let y = low; y <= high; ++y) {
        for (let x = left; x <= last; ++x) {
          const u = ((x - x0) * (y2 - y0) - (x2 - x0) * (y - y0)) / area, v = ((x1 - x0) * (y - y0) - (x - x0) * (y1 - y0)) / area;
          if (u < 0 || v < 0 || u + v > 1) continue;
          const z = z0 + u * (z1 - z0) + v * (z2 - z0), pixel = y * width + x;
          if (z <= depth[pixel]) continue;
          depth[pixel] = z;
          const share = 0.25 + 0.75 * (light[0] + u * (light[1] - light[0]) + v * (light[2] - light[0]));
          image.data.set([190 * share, 150 * share, 95 * share, 255], 4 * pixel);
        }
      }
    }
    this.image = image;
    this.depth = depth;
  }

  draw({ pen, proxy, force, hand }) {
    if (!this.image) this.paint();
    const paper = this.canvas.getContext("2d"), [right, up, out] = this.axes(), { width, height, per_m } = MESH_VIEW;
    const colour = colours();
    const along = (axis, p) => axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
    const seen = (p) => [width / 2 + per_m * along(right, p), height / 2 - per_m * along(up, p)];
    const line = (from, to, name, wide) => {
      paper.strokeStyle = colour(name);
      paper.lineWidth = wide;
      draw_line(paper, [from, to]);
    };
    const dot = (p, name, radius) => {
      paper.fillStyle = colour(name);
      paper.beginPath(); paper.arc(...p, radius, 0, 7); paper.fill();
    };
    paper.putImageData(this.image, 0, 0);
    const tip = seen(pen), [x, y] = tip.map(Math.round), newton = Math.hypot(...force);
    line(seen(vector_plus(pen, [0.012, -0.006, 0.03])), tip, "--steel", 6);
    line(tip, seen(hand), "--hand", 2);
    dot(tip, this.depth[y * width + x] > per_m * along(out, pen) ? "--faint" : "--ball", 6);
    if (proxy) dot(seen(proxy), "--blue", 5);
    if (newton < 0.005) return;
    const end = seen(vector_plus(pen, force, 0.02));
    line(tip, end, "--red", 4);
    dot(end, "--red", 5);
    paper.font = "700 24px system-ui";
    paper.fillText(`${fixed(newton, 2)} N`, Math.min(width - 90, end[0] + 12), Math.max(24, end[1] - 8));
  }
}

/** Where triangles cross the plane y = `y_m`: the path of a drawing of x and z. */
function mesh_section(triangles, y_m, place) {
  let text = "";
  for (let n = 0; n < triangles.length; n += MESH_VIEW.floats) {
    const ends = [];
    for (let k = 0; k < 3; ++k) {
      const a = n + 3 * k, b = n + 3 * ((k + 1) % 3), above = triangles[a + 1] - y_m, after = triangles[b + 1] - y_m;
      if (above < 0 === after < 0) continue;
      const share = above / (above - after), between = (i) => triangles[a + i] + share * (triangles[b + i] - triangles[a + i]);
      ends.push(place([between(0), y_m, between(2)]));
    }
    if (ends.length === 2) text += path(ends);
  }
  return text;
}
