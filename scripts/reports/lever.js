// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Moves the levers of a page by rows of their runs, and the cursors of the charts beside them.
// The numbers come from lever.py. Documentation: docs/figures.md
(() => {
  const ARROW = 64;

  function arrow(torque, scale, start = 12) {
    const share = Math.max(-1.4, Math.min(1.4, torque / scale));
    if (Math.abs(share) < 0.03) return "";
    const side = Math.sign(share), tip = side * start + share * ARROW;
    const back = tip - side * Math.min(9, Math.abs(share) * ARROW);
    return `M${side * start} 0H${tip}M${back} -6L${tip} 0L${back} 6`;
  }

  const newtonmetres = (mnm) => (mnm / 1000).toFixed(3).replace("-", "\u2212") + " Nm";

  for (const card of document.querySelectorAll(".moving")) {
    const run = card.querySelector("script");
    if (!run) continue; // a drawing of several axes stands still
    const data = JSON.parse(run.textContent);
    const part = (name) => card.querySelector(name);
    const slider = part("input"), button = part("button"), cursor = part(".cursor");
    const rows = data.angle_deg.length;
    const span = data.end_s - data.begin_s;
    let at = data.peak, playing = false, begun = false, last = 0;

    function tell(name, values, i) {
      const place = part(`.tell-${name}`);
      if (place && values) place.textContent = newtonmetres(values[i]);
    }

    function show() {
      const i = Math.min(rows - 1, Math.max(0, Math.round(at)));
      part(".arm").setAttribute("transform", `rotate(${data.angle_deg[i]})`);
      const motor = (data.felt_mnm || data.asked_mnm)[i];
      part(".arm .motor").setAttribute("d", arrow(motor, data.scale_mnm));
      if (data.hand_mnm) {
        part(".arm .hand").setAttribute("d", arrow(data.hand_mnm[i], data.scale_mnm));
      }
      const x = data.chart[0] + (data.chart[1] - data.chart[0]) * i / Math.max(1, rows - 1);
      cursor.setAttribute("transform", `translate(${x.toFixed(1)} 0)`);
      slider.value = i;
      const time = data.begin_s + span * i / Math.max(1, rows - 1);
      part(".tell-time").textContent = time.toFixed(3) + " s";
      part(".tell-angle").textContent = data.angle_deg[i].toFixed(1).replace("-", "\u2212") + "°";
      tell("asked", data.asked_mnm, i);
      tell("felt", data.felt_mnm, i);
      tell("hand", data.hand_mnm, i);
    }

    function step(now) {
      if (!playing) return;
      at += (now - last) / 1000 / (span * data.slower) * rows;
      last = now;
      if (at >= rows) at = 0;
      show();
      requestAnimationFrame(step);
    }

    function play(on) {
      if (on === playing) return;
      playing = on;
      button.textContent = on ? "\u275a\u275a" : "\u25b6";
      button.setAttribute("aria-label", on ? "Pause" : "Play");
      if (on && !begun) at = 0;
      begun = begun || on;
      last = performance.now();
      if (on) requestAnimationFrame(step);
    }

    slider.max = rows - 1;
    part(".controls").hidden = false;
    button.addEventListener("click", () => { card.dataset.chosen = "1"; play(!playing); });
    slider.addEventListener("input", () => {
      card.dataset.chosen = "1";
      play(false);
      at = Number(slider.value);
      show();
    });
    addEventListener("beforeprint", () => { play(false); at = data.peak; show(); });
    show();
    // By itself only while it is looked at, and never where the reader wants things to keep still.
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (still || !window.IntersectionObserver) continue;
    new IntersectionObserver((seen) => {
      if (!card.dataset.chosen) play(seen[seen.length - 1].isIntersecting);
    }, { threshold: 0.6 }).observe(card);
  }
})();
