// Inside the core: the loop stands still, goes on by a tick, and shows and keeps every word.
"use strict";

const SCALED = new Set(["A", "V", "Nm", "rad/s", "of full scale"]); // units of words with bits behind the point

/** The words of the last tick of a lever's core: name, integer, value in its unit. */
function words_of(device) {
  const words = device.loop.words(), values = device.loop.lastTicks().slice(-words.length), names = { limits: device.status.limits, faults: device.status.faults };
  return words.map(({ name, unit, fraction }, n) => {
    const value = SCALED.has(unit) ? `${fixed(values[n] / 2 ** fraction, 4)} ${unit}` : names[name] ?? unit;
    return { name, integer: values[n], value };
  });
}

/** A value change dump (IEEE 1364) of ticks: `rows` has the words of each, one after the other. */
function vcd_of(scope, words, rows, tick_hz) {
  const ids = words.map((_, n) => String.fromCharCode(33 + n));
  const bits = (n, value) => {
    const text = BigInt.asUintN(words[n].bits, BigInt(value)).toString(2);
    return words[n].bits === 1 ? `${text}${ids[n]}` : `b${text} ${ids[n]}`;
  };
  const lines = [`$version feltgate ${page.numbers.version}, ${scope}, simulated $end`, "$timescale 1 ps $end", `$scope module ${scope} $end`];
  words.forEach(({ name, bits: wide }, n) => lines.push(`$var wire ${wide} ${ids[n]} ${name}${wide > 1 ? ` [${wide - 1}:0]` : ""} $end`));
  for (const { name, unit, fraction } of words) if (SCALED.has(unit)) lines.push(`$comment ${name}: signed, of 2^-${fraction} ${unit} $end`);
  lines.push("$upscope $end", "$enddefinitions $end");
  const tick = words.findIndex(({ name }) => name === "tick"), time_ps = (row) => (BigInt(rows[row + tick]) * 1_000_000_000_000n) / BigInt(tick_hz);
  for (let row = 0; row < rows.length; row += words.length) {
    lines.push(`#${time_ps(row)}`);
    words.forEach((_, n) => { if (!row || rows[row + n] !== rows[row + n - words.length]) lines.push(bits(n, rows[row + n])); });
  }
  return lines.join("\n") + "\n";
}

/** Pause, step, table and download of the lever's tab. */
class Inside {
  constructor() {
    $("pause").onclick = () => { this.pause(!page.paused); this.show(); };
    $("step").onclick = () => { this.pause(true); devices((d) => say(d.step())); this.show(); };
    $("vcd").onclick = () => this.download();
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
      const table = document.createElement("table");
      table.createCaption().textContent = `${d.name}, tick ${words_of(d)[0].integer}`;
      for (const { name, integer, value } of words_of(d)) add_row(table, [name, integer, value]);
      return table;
    }));
  }

  download() {
    for (const d of page.devices) {
      const text = vcd_of(d.name.replace(/\W/g, "_"), d.loop.words(), Array.from(d.loop.lastTicks()), d.info.tick_hz);
      const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(new Blob([text], { type: "text/plain" })), download: `feltgate_${d.name}_${d.scene}.vcd` });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
    }
  }
}
