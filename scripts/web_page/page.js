// The page: controls, the frames, the verdict, the comparison of the bits.
"use strict";

const $ = (id) => document.getElementById(id);
const page = { tab: "lever", scene: "wall", values: {}, devices: [], grip: 1, speed: 0, frames: [], errors: [], borders: {}, paused: false, told: false, shows: false, shown_s: 0, count: 0 };
window.feltgate = page; // for whoever wants to look inside

/** Of each tab its title, and what makes its device when it is first opened; the lever is there. */
const TABS = {
  lever: ["lever"], pantograph: ["pantograph", PenTab], drums: ["drums", DrumsTab], materials: ["materials", MaterialsTab], coupled: ["two levers", CoupledTab],
  string: ["string", StringTab], stylus: ["stylus", StylusTab], gimbal: ["gimbal", GimbalTab], knob: ["knob", KnobTab], board: ["your board", BoardTab],
};

const option = (value, text) => Object.assign(document.createElement("option"), { value, textContent: text });
const devices = (act) => page.devices.forEach(act);

function place_device(n, design) {
  const device = new Device(page.core, design, $("plant").value, $("stages"));
  page.devices[n] = device;
  if (page.scene === "law") {
    say(device.loop.runLaw(page.law));
    const parameters = device.loop.lawParameters();
    device.law_words = Object.fromEntries(parameters.map((p) => [p.name, p.value]));
    SCENES.law.sliders = law_sliders(parameters);
  }
  device.loop.breakIt(Number($("break").value));
  apply_values(device);
  device.select(page.scene);
  device.loop.arm(true);
}

/** Both anew, so that they start together. */
function place_devices() {
  page.devices.forEach((device) => device.remove());
  page.devices.length = 0;
  $("stages").textContent = "";
  const designs = page.scene === "law" ? [LAW_DESIGN] : [$("first").value, $("second").value].filter(Boolean);
  designs.forEach((design, n) => place_device(n, design));
  $("grip").options[0].textContent = `a hand, up to ${fixed(page.devices[0].loop.status().gentle_nm / RADIUS_M, 1)} N`;
}

/** A law that compiles is felt at once, with the values that it says. */
function take_law(text) {
  if (text === page.law) return;
  page.law = text;
  for (const name of Object.keys(page.values)) if (name.startsWith("law:")) delete page.values[name];
  if (page.scene !== "law") return;
  place_devices();
  build_sliders();
}

function apply_values(device) {
  const rad = device.info.count_rad;
  for (const slider of SCENES[page.scene].sliders) {
    const value = page.values[slider.name];
    if (slider.choices || value === undefined) continue;
    if (slider.law) {
      if (device.law_words[slider.law] === value) continue;
      say(device.loop.setLaw(slider.law, Math.max(slider.low, Math.min(slider.high, value))));
      device.law_words[slider.law] = value;
      device.turn = null;
      continue;
    }
    const word = slider.per_count ? value * rad : slider.per_count2 ? value / rad ** 2 : value;
    say(device.set(slider.name, Math.min(word, device.ranges[slider.name].high)));
    // Within its core a charge is a spring that reaches the charge's torque at the core's edge.
    const core = slider.slope && geometry(page.scene, device.words, rad).core;
    if (core) say(device.set(slider.slope, Math.min((value / core ** 3) * rad, device.ranges[slider.slope].high)));
  }
  const g = geometry("wall", device.words, rad);
  device.loop.hostWall(page.values.rate || 1, g.contact, page.values.wall_stiffness || 4, page.values.wall_damping || 0);
}

function say(text) {
  if (!text) return;
  page.errors.push(text);
  $("verdict").textContent = text;
}

function select_scene(scene) {
  const other_design = !page.devices.length || (page.scene === "law") !== (scene === "law");
  page.scene = scene;
  $("law").hidden = scene !== "law";
  $("lever").classList.toggle("writes", scene === "law"); // stage and editor side by side
  if (other_design) place_devices();
  build_sliders();
  devices((d) => { apply_values(d); say(d.select(scene)); });
  if (scene === "law" && !$("law-table").textContent) page.editor.check();
  $("begin").textContent = SCENES[scene].begin;
  ask_verdict();
}

function build_sliders() {
  const box = $("sliders");
  box.replaceChildren(Object.assign(document.createElement("legend"), { textContent: "Object" }));
  for (const s of SCENES[page.scene].sliders) {
    const label = document.createElement("label"), shown = document.createElement("output");
    label.className = "slider";
    page.values[s.name] ??= s.choices ? 1 : s.value;
    if (s.choices) {
      const select = document.createElement("select");
      s.choices.forEach(([text, ticks]) => select.append(option(ticks, text)));
      select.value = page.values[s.name];
      select.oninput = () => turned(s, Number(select.value), shown);
      label.append(s.label, select);
    } else {
      const range = Object.assign(document.createElement("input"), { type: "range", min: 0, max: 1000 });
      const whole = (v) => (s.step === 1 ? Math.round(v) : v);
      const value_of = (x) => whole(s.log ? s.low * (s.high / s.low) ** (x / 1000) : s.low + ((s.high - s.low) * x) / 1000);
      const x_of = (v) => 1000 * (s.log ? Math.log(v / s.low) / Math.log(s.high / s.low) : (v - s.low) / (s.high - s.low));
      range.value = x_of(page.values[s.name]);
      range.setAttribute("aria-label", `${s.label} in ${s.unit}`);
      range.oninput = () => turned(s, value_of(Number(range.value)), shown);
      shown.textContent = `${fixed(page.values[s.name])} ${s.unit}`;
      const track = document.createElement("span");
      track.className = "track";
      track.append(range);
      if (s.border) page.track = { element: track, share_of: (v) => Math.max(0, Math.min(1, x_of(v) / 1000)) };
      label.append(s.label, track, shown);
    }
    box.append(label);
  }
}

function turned(slider, value, shown) {
  page.values[slider.name] = value;
  if (!slider.choices) shown.textContent = `${fixed(value)} ${slider.unit}`;
  devices(apply_values);
  ask_verdict();
}

/** The border of a device's wall as `feltgate stability` has it: by eigenvalues, without friction and without a hand. */
async function border_of(device, damping, rate) {
  const asked = [device.name, $("plant").value, damping, rate];
  return (page.borders[asked.join()] ??= await page.worker.call("border", ...asked));
}

/** Borders and verdict of the present wall; while they are computed a later wish waits, the newest one alone. */
async function ask_verdict() {
  const asks = () => page.scene === "wall" && $("object").open;
  if (!asks()) show_borders([]);
  page.ask_again = true;
  if (page.asking) return;
  page.asking = true;
  while (page.ask_again && asks()) {
    page.ask_again = false;
    const { wall_damping, rate } = page.values, borders = [];
    for (const d of [...page.devices]) borders.push({ name: d.name, ...(await border_of(d, wall_damping, rate)) });
    if (asks()) show_borders(borders);
  }
  page.asking = false;
}

/** A mark of each device's border on the slider of the stiffness, and the verdict in words. */
function show_borders(borders) {
  const box = $("verdict"), stiffness = page.values.wall_stiffness, lines = [];
  let shakes = false;
  page.shown_borders = borders;
  document.querySelectorAll(".track i").forEach((mark) => mark.remove());
  for (const b of borders) {
    if (b.error) { lines.push(b.error); continue; }
    const over = stiffness > b.stiffness_nm_rad, said = `the border is ${fixed(b.stiffness_nm_rad, 1)} Nm/rad, it swings there at ${fixed(b.rad_s / 2 / Math.PI, 0)} Hz`;
    shakes = shakes || over;
    lines.push(`${b.name}: ${over ? "this wall shakes" : "stable"}; ${said}.`);
    const mark = Object.assign(document.createElement("i"), { title: `${b.name}: ${said}` });
    mark.style.setProperty("--at", page.track.share_of(b.stiffness_nm_rad));
    page.track.element.append(mark);
  }
  box.textContent = borders.length ? lines.join(" ") + " By eigenvalues, without friction and hand, which both steady it: the red part of the slider is beyond." : "";
  box.className = shakes ? "shakes" : "";
}

function build_controls() {
  page.inside = new Inside();
  $("object").ontoggle = ask_verdict;
  for (const scene of Object.keys(SCENES)) {
    const label = document.createElement("label"), radio = document.createElement("input");
    Object.assign(radio, { type: "radio", name: "scene", value: scene, checked: scene === page.scene });
    radio.onchange = () => select_scene(scene);
    label.append(radio, " " + SCENES[scene].title);
    $("scenes").append(label);
  }
  for (const name of page.core.designNames().filter((design) => design !== LAW_DESIGN)) {
    $("first").append(option(name, name));
    $("second").append(option(name, name));
  }
  $("second").prepend(option("", "none"));
  $("second").value = "";
  for (const id of ["first", "second", "plant"]) $(id).oninput = () => { place_devices(); ask_verdict(); };
  $("break").oninput = break_it;
  $("grip").oninput = () => { page.grip = Number($("grip").value); devices((d) => d.held && d.take(true)); };
  $("arm").onclick = () => devices((d) => d.loop.arm(true));
  $("clear").onclick = () => devices((d) => d.loop.clearFaults());
  $("stop").onclick = () => {
    const pressed = $("stop").getAttribute("aria-pressed") !== "true";
    press("stop", pressed);
    devices((d) => d.loop.stop(pressed));
  };
  document.addEventListener("keydown", (event) => {
    if (page.tab !== "lever" || event.ctrlKey || event.altKey || event.metaKey || /INPUT|SELECT|TEXTAREA/.test(event.target.tagName)) return;
    const button = { a: "arm", s: "stop", c: "clear", p: "pause", n: "step" }[event.key.toLowerCase()];
    if (button) $(button).click();
  });
  document.addEventListener("dragover", (event) => event.preventDefault());
  document.addEventListener("drop", async (event) => {
    event.preventDefault();
    const file = event.dataTransfer.files[0];
    if (!file || !/\.glb$/i.test(file.name)) return;
    select_tab("stylus");
    await page.stylus.open(file);
  });
  $("check").onclick = compare_bits;
}

async function compare_bits() {
  const table = document.createElement("table");
  $("hashes").replaceChildren(table);
  page.compared = [];
  const compare = async (design, scene, hash, ...call) => {
    const found = await page.worker.call(...call), same = found === hash;
    page.compared.push({ design, scene, found, same });
    add_row(table, [design, scene, found, same ? "same" : `native ${hash}`]).lastChild.className = same ? "same" : "differs";
  };
  for (const r of page.numbers.recorded) await compare(r.design, r.scene, r.hash, "hash", r.design, r.inputs);
  for (const p of page.numbers.planes) await compare("planes of a stroke", p.mesh, p.hash, "planesHash");
  page.done = true;
}

/** Simulated over computing time goes into the speed that the page shows. */
function run_timed(passed, act) {
  const begin = performance.now();
  act();
  const used = (performance.now() - begin) / 1000;
  if (used > 0) page.speed += (page.speed ? 0.05 : 1) * (passed / used - page.speed);
}

/** Out of every fault: what is broken is mended, which starts the devices anew, for counts were lost. */
function recover() {
  press("stop", false);
  if ($("break").value !== "0") {
    $("break").value = "0";
    say_broken();
    place_devices();
  } else devices((d) => d.recover());
}

/** Breaks what is chosen, says what is to be expected, and shows it by a hand where nobody holds the lever. */
function break_it() {
  const what = Number($("break").value), free = page.shows || !page.devices.some((d) => d.held);
  devices((d) => d.loop.breakIt(what));
  if (what && free && page.may_show) {
    page.shows = true;
    page.shown_s = 0;
  }
  say_broken();
}

/** What is to be expected of what is broken, and what there is. */
function say_broken() {
  const broken = BROKEN[$("break").value], first = page.devices[0], now = first && first.now;
  if (!broken) return ($("expect").textContent = "");
  const found = first.status && first.status.faults ? `Now: fault ${first.status.faults}.` : `Now: asked ${fixed(now.tau_ref / RADIUS_M, 1)} N, the motor gives ${fixed(now.torque / RADIUS_M, 1)} N.`;
  $("expect").textContent = `${broken.expect} ${found}`;
}

/** The others stand still; a tab's device is made when it is first opened. */
function select_tab(name) {
  page.tab = name;
  for (const tab of document.querySelectorAll("[role=tab]")) {
    const chosen = tab.id === `tab-${name}`;
    tab.setAttribute("aria-selected", chosen);
    tab.tabIndex = chosen ? 0 : -1;
    $(tab.getAttribute("aria-controls")).hidden = !chosen;
  }
  const make = TABS[name][1];
  if (make && !page[name]) {
    page[name] = new make(page.core, page.numbers);
    page.address.opened(name, true);
  }
  $("devices-name").textContent = $(`tab-${name}`).textContent;
  page.speed = 0;
}

function build_tabs() {
  $("tabs").innerHTML = Object.entries(TABS).map(([name, [title]]) => `<button type="button" role="tab" id="tab-${name}" aria-controls="${name}">${title}</button>`).join("");
  const tabs = [...$("tabs").children];
  tabs.forEach((tab, n) => {
    const name = tab.getAttribute("aria-controls");
    tab.onclick = (event) => {
      select_tab(name);
      if (event.detail) $("devices").open = false; // by the arrow keys the next one is near
    };
    tab.onkeydown = (event) => {
      const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (!step) return;
      const next = tabs[(n + step + tabs.length) % tabs.length];
      next.focus();
      next.click();
    };
  });
  const wanted = page.address.wanted.get("tab");
  select_tab(tabs.some((tab) => tab.id === `tab-${wanted}`) ? wanted : "lever");
}

function frame(time) {
  requestAnimationFrame(frame);
  const passed = Math.min((time - (page.last || time)) / 1000, 0.05);
  page.last = time;
  if (passed <= 0) return;
  keep(page.frames, 600, time);
  if (page.tab === "lever") lever_frame(passed);
  else page[page.tab].frame(passed);
  if (page.frames.length === 1) page.first_frame_ms = performance.now();
  if (++page.count % 15) return;
  $("speed").textContent = `${fixed(page.speed, 1)}× real time`;
  if (page.tab === "lever") {
    page.inside.show();
    say_broken();
  }
  page.address.write();
}

function lever_frame(passed) {
  if (!page.paused) {
    if (page.shows) devices((d) => d.show(page.shown_s));
    page.shown_s += passed;
    run_timed(passed, () => devices((d) => {
      const error = d.advance(Math.round(passed * d.info.tick_hz));
      if (error) { say(error); d.loop.arm(false); }
    }));
  }
  devices((d) => d.draw(page.values));
  draw_curves(page.devices);
  if (page.scene === "law") draw_turn(page.devices[0]);
}

(async () => {
  Object.assign(page, await load_core());
  $("version").textContent = page.numbers.version;
  page.law = page.numbers.laws.detent;
  page.shows = page.may_show = !window.matchMedia("(prefers-reduced-motion: reduce)").matches;
  page.address = new Address();
  build_controls();
  page.address.restore_lever();
  page.editor = new LawEditor(page.numbers.laws, page.law, page.worker, take_law);
  document.querySelector(`#scenes input[value=${page.scene}]`).checked = true;
  select_scene(page.scene);
  build_tabs();
  requestAnimationFrame(frame);
  page.ready = true;
})();
