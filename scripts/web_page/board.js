// A board by Web Serial: the frames and requests of docs/link.md, and a tab that reads, writes, streams, arms and stops.
"use strict";

const LINK = { wait_ms: 50, patience_ms: 2000 }; // for a reply, and in all

const CRC_TABLE = Uint32Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; ++k) n = n & 1 ? (n >>> 1) ^ 0xedb88320 : n >>> 1;
  return n;
});
const crc32 = (bytes) => ~bytes.reduce((crc, byte) => CRC_TABLE[(crc ^ byte) & 0xff] ^ (crc >>> 8), ~0) >>> 0;
const words_from = (bytes, at) => {
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  return Array.from({ length: (bytes.length - at) >> 2 }, (_, n) => view.getUint32(at + 4 * n, true));
};

/** What goes over the wire for a payload; `link` has the constants of the map. */
function framed(body, link) {
  const sum = crc32(body), wire = [link.frame_end];
  for (const byte of [...body, sum & 0xff, (sum >>> 8) & 0xff, (sum >>> 16) & 0xff, sum >>> 24]) {
    if (byte === link.frame_end) wire.push(link.frame_escape, link.escaped_end);
    else if (byte === link.frame_escape) wire.push(link.frame_escape, link.escaped_escape);
    else wire.push(byte);
  }
  return Uint8Array.from([...wire, link.frame_end]);
}

/** Bytes to payloads; what is no good frame is counted. */
class FrameReader {
  constructor(link) {
    this.link = link;
    this.frame = [];
    this.bad = 0;
  }

  /** The payloads of the frames that end in these bytes. */
  take(bytes) {
    const good = [];
    for (const byte of bytes) {
      if (byte !== this.link.frame_end) { this.frame.push(byte); continue; }
      const body = this.unescaped();
      this.frame = [];
      if (!body || !body.length) { this.bad += body ? 0 : 1; continue; }
      if (body.length > 4 && words_from(body.slice(-4), 0)[0] === crc32(body.slice(0, -4))) good.push(body.slice(0, -4));
      else ++this.bad;
    }
    return good;
  }

  unescaped() {
    const { frame_end, frame_escape, escaped_end, escaped_escape } = this.link, body = [];
    for (let n = 0; n < this.frame.length; ++n) {
      if (this.frame[n] !== frame_escape) body.push(this.frame[n]);
      else if (this.frame[++n] === escaped_end) body.push(frame_end);
      else if (this.frame[n] === escaped_escape) body.push(frame_escape);
      else return null;
    }
    return Uint8Array.from(body);
  }
}

/** One request at a time over an open SerialPort; `told` gets {number, words, values} of each frame of the stream. */
class BoardLink {
  constructor(port, link, told = () => {}) {
    Object.assign(this, { port, link, told, frames: new FrameReader(link), sequence: 0, last: Promise.resolve(), awaited: null, repeats: 0 });
    this.writer = port.writable.getWriter();
    this.reader = port.readable.getReader();
    this.listening = this.listen();
  }

  async listen() {
    try {
      for (;;) {
        const { value, done } = await this.reader.read();
        if (done) break;
        for (const body of this.frames.take(value)) this.arrived(body);
      }
    } catch (error) { this.lost = error; }
    this.ended = true;
  }

  arrived(body) {
    if (body[0] === this.link.kind_stream) this.told({ number: body[1], words: body[2] | (body[3] << 8), values: words_from(body, 4) });
    else if (this.awaited && this.awaited.head.every((byte, n) => byte === body[n])) this.awaited.take(words_from(body, 4));
  }

  /** The words of the reply; the same bytes again where none comes. Requests wait for each other. */
  ask(kind, address, value) {
    const asked = this.last.then(() => this.send(kind, address, value));
    this.last = asked.catch(() => {});
    return asked;
  }

  async send(kind, address, value) {
    this.sequence = (this.sequence + 1) & 0xff;
    const body = new Uint8Array(8), view = new DataView(body.buffer), wire = () => framed(body, this.link);
    body.set([kind, this.sequence]);
    view.setUint16(2, address, true);
    view.setUint32(4, value, true);
    const reply = new Promise((take) => (this.awaited = { head: [kind | this.link.kind_reply, ...body.slice(1, 4)], take }));
    for (let tried = 0; tried * LINK.wait_ms < LINK.patience_ms; ++tried) {
      if (this.ended) throw new Error("the port was closed");
      this.repeats += tried > 0;
      await this.writer.write(wire());
      const words = await Promise.race([reply, new Promise((late) => setTimeout(late, LINK.wait_ms))]);
      if (words) return words;
    }
    throw new Error(`no answer for ${LINK.patience_ms / 1000} s; is the board on, is this its port, does the rate fit?`);
  }

  read(address, count = 1) { return this.ask(this.link.kind_read, address, count); }
  /** The status of the tick after it. */
  async write(address, value) { return (await this.ask(this.link.kind_write, address, value >>> 0))[0]; }

  /** Begins with another sequence than that of the last write; what the board says of itself. */
  async begin({ words }) {
    this.sequence = (await this.read(words.last_write_sequence))[0] & 0xff;
    const [identity, version, design_crc, clock_hz, clocks_per_tick, features] = await this.read(words.identity, 6);
    return { identity, version, design_crc, tick_hz: clock_hz / clocks_per_tick, features };
  }

  async close() {
    await this.reader.cancel();
    await this.listening;
    this.reader.releaseLock();
    this.writer.releaseLock();
    await this.port.close();
  }
}

/** The board's tab; `map` is the register map. */
class BoardTab {
  constructor(core, { registers }) {
    this.map = registers;
    this.streamed = ["position", "tick", "tau_hat", "tau_ref"];
    this.trace = [];
    this.shown = {};
    const acts = { connect: () => (this.link ? this.leave() : this.connect()), arm: () => this.arm(true), disarm: () => this.arm(false), stop: () => this.stop(), clear: () => this.command("clear_faults"), read: () => this.peek(), write: () => this.poke() };
    for (const [name, act] of Object.entries(acts)) {
      $(`board-${name}`).onclick = () => act().catch((error) => this.say(error.message));
      $(`board-${name}`).disabled = name !== "connect";
    }
    for (const [name, number] of Object.entries(this.map.scenes)) $("board-scene").append(option(number, name));
    $("board-names").append(...Object.keys(this.map.words).map((name) => option(name, "")));
    if (!navigator.serial) {
      $("board-connect").disabled = true;
      this.say("This browser has no Web Serial; Chromium, Chrome and Edge have it, on https: and on localhost (feltgate page --serve).");
    }
  }

  say(text) { $("board-said").textContent = text; }

  async connect() {
    const port = await navigator.serial.requestPort();
    await port.open({ baudRate: Number($("board-baud").value) });
    this.link = new BoardLink(port, this.map.link, (frame) => this.take(frame));
    try {
      const board = await this.link.begin(this.map);
      if (board.identity !== this.map.link.identity || board.version >>> 16 !== this.map.link.version >>> 16) throw new Error("what is there is no feltgate board of this page's version");
      const { words, bits } = this.map;
      this.say(`${(board.features >>> bits["features.simulated"]) & 1 ? "SIMULATED" : "a board"}, design ${board.design_crc.toString(16).padStart(8, "0")}, ${board.tick_hz} ticks a second`);
      await this.link.write(words.stream_words, this.streamed.reduce((mask, name) => mask | (1 << this.map.snapshot.indexOf(name)), 0));
      await this.link.write(words.stream_period, Math.round(board.tick_hz / 100));
    } catch (error) {
      await this.leave();
      throw error;
    }
    this.enable(true);
  }

  enable(on) {
    $("board-connect").textContent = on ? "Leave" : "Connect…";
    for (const name of ["arm", "disarm", "stop", "clear", "read", "write"]) $(`board-${name}`).disabled = !on;
  }

  /** Disarms, if the board still answers. */
  async leave() {
    const link = this.link;
    this.link = this.asked = null;
    clearInterval(this.kicks);
    this.enable(false);
    for (const name of ["control", "stream_period"]) await link.write(this.map.words[name], 0).catch(() => {});
    await link.close().catch(() => {});
  }

  bit(name) { return 1 << this.map.bits[name]; }

  /** Kicks the watchdog three times in its usual 0.1 s from the first arming on. What is asked for last holds: an arming
   * that still waits for the reply to its kick ends with a later disarming. */
  async arm(on) {
    const { words, bits } = this.map, scene = Number($("board-scene").value) << bits["control.scene"], asked = {};
    this.asked = asked;
    clearInterval(this.kicks);
    if (on) {
      await this.command("kick");
      if (this.asked !== asked) return;
      this.kicks = setInterval(() => this.command("kick").catch((error) => { clearInterval(this.kicks); this.say(error.message); }), 30);
    }
    this.status(await this.link.write(words.control, this.bit("control.host") | (on ? this.bit("control.arm") | scene : 0)));
  }

  stop() {
    this.asked = null; // an arming that still waits
    return this.command("stop");
  }

  async command(name) { this.status(await this.link.write(this.map.words.command, this.bit(`command.${name}`))); }

  status(word) {
    this.armed = !!(word & this.bit("status.armed"));
    $("board-state").textContent = this.armed ? "armed" : "disarmed";
    $("board-state").className = `state ${this.armed ? "armed" : ""}`;
  }

  /** A name of the map, or an address. */
  address() {
    const text = $("board-word").value.trim(), address = this.map.words[text] ?? Number(text);
    if (text && Number.isInteger(address) && address >= 0 && address < 2 ** (this.map.link.map_bits + 1)) return address;
    throw new Error(`${text || "nothing"} is no word of the map; write a name, or an address as 0x300`);
  }

  async peek() { [$("board-value").value] = await this.link.read(this.address()); }

  async poke() {
    const value = Number($("board-value").value);
    if (!Number.isInteger(value) || value < -(2 ** 31) || value >= 2 ** 32) throw new Error(`${$("board-value").value} is no word of 32 bits`);
    const status = await this.link.write(this.address(), value);
    this.status(status);
    this.say(status & this.bit("status.refused") ? "refused: the motor is armed" : "written");
  }

  /** A frame of the stream: values in the order of the bits. */
  take({ words, values }) {
    const names = this.map.snapshot.filter((_, n) => words & (1 << n));
    names.forEach((name, n) => (this.shown[name] = name === "tick" ? values[n] : values[n] | 0));
    keep(this.trace, 400, [this.shown.position, this.shown.tau_ref]);
  }

  frame() {
    $("board-values").textContent = Object.entries(this.shown).map(([name, value]) => `${name} ${value}`).join(", ");
    draw_traces($("board-angle"), "position, counts, the last 4 s", [{ text: "position", colour: "--ink", values: this.trace.map(([angle]) => angle) }], 400, 10);
    draw_traces($("board-torque"), "torque asked, integer of its word", [{ text: "tau_ref", colour: "--red", values: this.trace.map(([, torque]) => torque) }], 400, 10);
  }
}
