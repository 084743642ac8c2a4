// Two materials side by side: one hand's wish leads both levers into them.
"use strict";

const FACE_RAD = 0.4; // where both materials begin
const MOST_RAD = 0.6;
const SAMPLE_S = 0.001, TRACE = 1000; // torques that the curve keeps: 1 s

class MaterialStage {
  constructor(tab, place, name) {
    this.tab = tab;
    const leads = { aim: (rad) => tab.aim(rad), step: (rad) => tab.aim(tab.lead + rad) };
    this.picture = lever_stage(place, name, "Lever in a material", MOST_RAD, leads);
    this.choose(name);
  }

  /** A fresh lever in the material of a shipped scene. */
  choose(name) {
    if (this.stick) this.stick.delete();
    this.name = name;
    this.values = this.tab.materials.find((m) => m.name === name).parameters;
    this.stick = this.tab.core.Lever.stick(this.tab.image);
    // One at a time, and the dynamic friction may never be above the static one.
    const { static: held, dynamic, ...others } = this.values;
    for (const [key, value] of [["dynamic", 0], ["static", held], ["dynamic", dynamic], ...Object.entries(others), ["face", FACE_RAD]]) {
      if (value !== undefined) say(this.stick.set(key, value));
    }
    this.seen = this.stick.state();
    this.trace = [];
    this.picture.name.textContent = name;
  }

  /** In slices, so that a vibration of 200 Hz is seen. */
  advance(seconds, from, to) {
    const slices = Math.max(1, Math.round(seconds / SAMPLE_S));
    for (let n = 1; n <= slices; ++n) {
      this.stick.lead(from + ((to - from) * n) / slices);
      say(this.stick.advance(seconds / slices));
      this.seen = this.stick.state();
      keep(this.trace, TRACE, this.seen.torque);
    }
  }

  draw() {
    const s = this.seen, { svg, caption } = this.picture;
    svg.innerHTML = `<path class="solid" d="${sector(Math.max(FACE_RAD, s.theta), 1.2, 60, 225)}"/><path class="object" d="${ray(FACE_RAD, 60, 225)}"/>` + held_bar(s.theta, s.hand, s.torque / RADIUS_M);
    svg.setAttribute("aria-valuenow", this.tab.lead.toFixed(2));
    caption.textContent = `${fixed(s.torque)} Nm, ${fixed(Math.max(0, s.theta - FACE_RAD))} rad deep\n` +
      Object.entries(this.values).filter(([key]) => key !== "face").map(([key, value]) => `${key} ${value}`).join(", ");
  }
}

class MaterialsTab {
  constructor(core, numbers) {
    this.core = core;
    this.image = numbers.material;
    this.materials = numbers.materials;
    this.lead = this.led = 0.3;
    this.stages = [0, 1].map((n) => new MaterialStage(this, $("materials-stages"), this.materials[n].name));
    this.stages.forEach((stage, n) => {
      const select = $(`material-${n}`);
      for (const { name } of this.materials) select.append(option(name, name));
      select.value = stage.name;
      select.oninput = () => stage.choose(select.value);
    });
    this.aim(0);
  }

  aim(lead) {
    this.lead = Math.max(-MOST_RAD, Math.min(MOST_RAD, lead));
  }

  frame(passed) {
    run_timed(passed, () => this.stages.forEach((stage) => stage.advance(passed, this.led, this.lead)));
    this.led = this.lead;
    this.stages.forEach((stage) => stage.draw());
    const lines = this.stages.map((stage, n) => ({ text: `${n ? "right" : "left"}: ${stage.name}`, colour: n ? "--red" : "--blue", values: stage.trace }));
    draw_traces($("materials-torque"), "torque, Nm, the last second", lines, TRACE, 0.05);
  }
}
