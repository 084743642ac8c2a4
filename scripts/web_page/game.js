// The guessing game: a hidden shape, a guess, its time; kept in this browser, exported as CSV.
"use strict";

const GUESSES = "feltgate.guesses";
const COLUMNS = ["when", "shape", "guess", "right", "seconds", "stiffness_cue", "damping_cue", "force_shown"];
// With cues each shape has a material; that of the fish is the study's, the others are assumed.
const MATERIALS = {
  duck: [HARD, STICKY], bell: [HARD, SLIPPERY], banana: [SOFT, SLIPPERY], fish: [SOFT, SLIPPERY],
  horseshoe: [HARD, STICKY], mushroom: [SOFT, STICKY], square: [HARD, SLIPPERY],
};
const PUBLISHED = { right: 52, of: 70, shapes: 7 };

class Game {
  constructor(tab, names) {
    this.tab = tab;
    this.names = names;
    this.bag = [];
    this.guesses = this.read();
    for (const name of names) {
      const button = Object.assign(document.createElement("button"), { type: "button", textContent: name, disabled: true });
      button.onclick = () => this.guess(name);
      $("game-names").append(button);
    }
    $("game-next").onclick = () => this.next();
    $("game-forget").onclick = () => { this.guesses = []; this.keep(); this.report(); };
    this.report();
  }

  read() {
    try {
      const kept = JSON.parse(localStorage.getItem(GUESSES) || "[]");
      return kept.filter((g) => this.names.includes(g.shape) && this.names.includes(g.guess) && g.seconds >= 0);
    } catch {
      return [];
    }
  }

  keep() {
    try {
      localStorage.setItem(GUESSES, JSON.stringify(this.guesses));
      $("game-kept").textContent = "";
    } catch {
      $("game-kept").textContent = "This browser keeps nothing for this page: export before you leave it.";
    }
  }

  /** The law of the round's shape, and its outline once it is guessed. */
  load() {
    const shape = this.tab.named(this.shape), material = MATERIALS[this.shape];
    this.tab.stage.load(shape, this.cues[0] ? material[0] : HARD, this.cues[1] ? material[1] : SLIPPERY);
    this.tab.stage.shown = this.open ? [] : [[shape]];
  }

  /** All shapes once in random order, then again. */
  next() {
    if (!this.bag.length) this.bag = this.names.map((name) => [Math.random(), name]).sort(([a], [b]) => a - b).map(([, name]) => name);
    this.shape = this.bag.pop();
    this.cues = [$("cue-stiffness").checked, $("cue-damping").checked];
    this.open = true;
    this.tab.stage.place(0, 0.06);
    this.load();
    this.began = null;
    this.seconds = 0;
    this.buttons(true);
    $("game-said").textContent = "A shape is hidden. The clock starts when the pen moves.";
  }

  touched() {
    if (this.tab.mode === "game" && this.open) this.began ??= performance.now();
  }

  tell_time() {
    if (this.open && this.began !== null) this.seconds = (performance.now() - this.began) / 1000;
    $("game-time").textContent = `${fixed(this.seconds, 0)} s`;
  }

  buttons(open) {
    for (const button of $("game-names").children) button.disabled = !open;
  }

  guess(name) {
    if (!this.open) return;
    this.tell_time();
    this.open = false;
    this.buttons(false);
    const right = name === this.shape;
    this.guesses.push({
      when: new Date().toISOString(), shape: this.shape, guess: name, right, seconds: Math.round(10 * this.seconds) / 10,
      stiffness_cue: this.cues[0], damping_cue: this.cues[1], force_shown: this.tab.stage.arrow,
    });
    this.keep();
    $("game-said").textContent = right ? `Right: ${name}.` : `It is the ${this.shape}, not the ${name}.`;
    this.tab.stage.shown = [[this.tab.named(this.shape)]];
    this.report();
  }

  csv() {
    return [COLUMNS, ...this.guesses.map((g) => COLUMNS.map((column) => g[column]))].map((row) => row.join(",")).join("\n") + "\n";
  }

  report() {
    const rows = [["cues", "guesses", "right", "mean time"]];
    const share = (right, of) => (of ? `${fixed((100 * right) / of, 1)} %` : "");
    const add = (title, list) => {
      const right = list.filter((g) => g.right).length, seconds = list.reduce((sum, g) => sum + g.seconds, 0);
      rows.push([title, list.length, share(right, list.length), list.length ? `${fixed(seconds / list.length, 1)} s` : ""]);
    };
    for (const [title, stiffness, damping] of [["none", false, false], ["stiffness", true, false], ["damping", false, true], ["both", true, true]]) {
      add(title, this.guesses.filter((g) => g.stiffness_cue === stiffness && g.damping_cue === damping));
    }
    add("all of yours", this.guesses);
    rows.push(["people at the device", PUBLISHED.of, share(PUBLISHED.right, PUBLISHED.of), ""], ["chance", "", share(1, PUBLISHED.shapes), ""]);
    fill($("game-shares"), rows);
    const count = (shape, guess) => this.guesses.filter((g) => g.shape === shape && g.guess === guess).length || "";
    fill($("game-confusion"), [["is, guessed", ...this.names], ...this.names.map((shape) => [shape, ...this.names.map((guess) => count(shape, guess))])]);
    $("game-export").href = `data:text/csv;charset=utf-8,${encodeURIComponent(this.csv())}`;
  }
}

/** Rows into a table, the first row and column as heads. */
function fill(table, rows) {
  table.replaceChildren();
  rows.forEach((cells, n) => {
    const row = table.insertRow();
    cells.forEach((text, m) => {
      const cell = document.createElement(n && m ? "td" : "th");
      cell.textContent = text;
      row.append(cell);
    });
  });
}
