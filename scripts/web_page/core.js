// The compiled core: unpacked once, instantiated here and in a worker that does what takes long.
"use strict";

const text_of = (id) => document.getElementById(id).textContent;

async function unpacked(base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** {numbers, core, worker}: what the native programs found, the core, and a core in a worker. */
async function load_core() {
  const [wasm, glue, numbers] = await Promise.all(["wasm", "engine", "numbers"].map((id) => unpacked(text_of(id))));
  const source = new TextDecoder().decode(glue);
  const make = new Function(source + "\nreturn Feltgate;")();
  const core = await make({ wasmBinary: wasm });
  return { core, numbers: JSON.parse(new TextDecoder().decode(numbers)), worker: new CoreWorker(source, wasm) };
}

/** Calls of the core's functions that would hold up the picture. */
class CoreWorker {
  constructor(source, wasm) {
    const serve = `${source}
      let core = null;
      onmessage = async ({ data }) => {
        if (data.wasm) { core = Feltgate({ wasmBinary: data.wasm }); return; }
        const module = await core;
        postMessage({ id: data.id, result: module[data.name](...data.args) });
      };`;
    this.worker = new Worker(URL.createObjectURL(new Blob([serve], { type: "text/javascript" })));
    this.worker.postMessage({ wasm });
    this.waiting = new Map();
    this.next = 0;
    this.worker.onmessage = ({ data }) => {
      this.waiting.get(data.id)(data.result);
      this.waiting.delete(data.id);
    };
  }

  call(name, ...args) {
    const id = this.next++;
    this.worker.postMessage({ id, name, args });
    return new Promise((resolve) => this.waiting.set(id, resolve));
  }
}
