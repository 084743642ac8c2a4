// The address of the page says what is shown: tab, scene, sliders, designs and law, where they are not as at the start.
"use strict";

/** Controls of a tab that have their state themselves; the lever's sliders are made anew for each scene. */
const controls_of = (tab) => [...$(tab).querySelectorAll("input, select")].filter((e) => e.type !== "file" && !e.closest("#sliders, #scenes, #law"));
const key_of = (control) => (control.type === "radio" ? control.name : control.id);
const state_of = (control) => (control.type === "checkbox" ? String(Number(control.checked)) : control.value);
const states_of = (tab) => Object.fromEntries(controls_of(tab).filter((e) => e.type !== "radio" || e.checked).map((e) => [key_of(e), state_of(e)]));

class Address {
  constructor() {
    this.wanted = new URLSearchParams(location.hash.slice(1));
    this.first = {}; // of each tab, what its controls say at first
    window.addEventListener("hashchange", () => location.reload());
  }

  /** The tab's controls are there: they take what the address says of them; `tell` lets them act. */
  opened(tab, tell) {
    this.first[tab] = states_of(tab);
    for (const control of controls_of(tab)) {
      const value = this.wanted.get(key_of(control));
      if (value === null) continue;
      const before = control.value;
      if (control.type === "checkbox") control.checked = value === "1";
      else if (control.type === "radio") control.checked = control.value === value;
      else control.value = value;
      if (control.type.startsWith("select") && control.value !== value) control.value = before;
      if (!tell || (control.type === "radio" && !control.checked)) continue;
      for (const kind of ["input", "change"]) control.dispatchEvent(new Event(kind, { bubbles: true }));
    }
  }

  /** Scene and law, before the first lever is made. */
  restore_lever() {
    const of = (name) => this.wanted.get(name);
    if (SCENES[of("scene")]) page.scene = of("scene");
    page.law = page.numbers.laws[of("law")] ?? of("law_text") ?? page.law;
    this.opened("lever", false);
    page.grip = Number($("grip").value);
    const sliders = new Map(SCENES[page.scene].sliders.map((s) => [s.name, s]));
    for (const [name, text] of this.wanted) {
      const value = Number(text), s = sliders.get(name);
      if (!Number.isFinite(value)) continue;
      if (name.startsWith("law:")) page.values[name] = value;
      else if (s && (!s.choices || s.choices.some(([, ticks]) => ticks === value))) page.values[name] = s.choices ? value : Math.max(s.low, Math.min(s.high, value));
    }
  }

  /** What tells this page from a new one. */
  text() {
    const say = new URLSearchParams(), now = states_of(page.tab), first = this.first[page.tab];
    if (page.tab !== "lever") say.set("tab", page.tab);
    else {
      if (page.scene !== "wall") say.set("scene", page.scene);
      for (const s of SCENES[page.scene].sliders) {
        const value = page.values[s.name], usual = s.choices ? 1 : s.value;
        if (value !== undefined && value !== usual) say.set(s.name, String(Number(value.toPrecision(6))));
      }
      const law = Object.keys(page.numbers.laws).find((name) => page.numbers.laws[name] === page.law);
      if (page.scene === "law") law ? say.set("law", law) : say.set("law_text", page.law);
    }
    for (const [key, value] of Object.entries(now)) if (value !== first[key]) say.set(key, value);
    return say.toString();
  }

  write() {
    const text = this.text();
    if (text === this.written) return;
    if (text || location.hash) history.replaceState(null, "", `#${text}`);
    this.written = text;
  }
}
