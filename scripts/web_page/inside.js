// Inside the core: the loop stands still, goes on by a tick, and shows every word.
"use strict";

/** The words of the last tick of a lever's core: name, integer, value in its unit. */
function words_of(device) {
  const names = { limits: device.status.limits, faults: device.status.faults };
  return device.loop.words().map(({ name, unit, fraction, value: integer }) => {
    const value = fraction ? `${fixed(integer / 2 ** fraction, 4)} ${unit}` : names[name] ?? unit;
    return { name, integer, value };
  });
}

/** Pause, step and table of the lever's tab. */
class Inside {
  constructor() {
    $("pause").onclick = () => { this.pause(!page.paused); this.show(); };
    $("step").onclick = () => { this.pause(true); devices((d) => say(d.step())); this.show(); };
    $("inside").ontoggle = () => this.show();
  }

  pause(wanted) {
    page.paused = wanted;
    press("pause", wanted, wanted ? "Go on" : "Pause");
  }

  /** The table, where it is unfolded. */
  show() {
    if (!$("inside").open || !page.devices.every((d) => d.status)) return;
    $("words").replaceChildren(...page.devices.map((d) => {
      const table = document.createElement("table"), words = words_of(d);
      table.createCaption().textContent = `${d.name}, tick ${words[0].integer}`;
      for (const { name, integer, value } of words) add_row(table, [name, integer, value]);
      return table;
    }));
  }
}
