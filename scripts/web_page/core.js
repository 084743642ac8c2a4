// The compiled core: unpacked and compiled once, instantiated here and in a worker that does what takes long.
"use strict";

const text_of = (id) => document.getElementById(id).textContent;

async function unpacked(base64) {
  const packed = await fetch(`data:application/octet-stream;base64,${base64}`);
  return new Response(packed.body.pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

/** A core: an engine (Emscripten's function) with a compiled module. */
const instance_of = (make, module) => make({ instantiateWasm: (imports, done) => { WebAssembly.instantiate(module, imports).then((made) => done(made, module)); return {}; } });

/** {numbers, core, worker}: what the native programs found, the core, and a core in a worker. */
async function load_core() {
  const [module, glue, numbers] = await Promise.all([unpacked(text_of("wasm")).then(WebAssembly.compile), unpacked(text_of("engine")), unpacked(text_of("numbers"))]);
  const source = new TextDecoder().decode(glue);
  const core = await instance_of(new Function(source + "\nreturn Feltgate;")(), module);
  return { core, numbers: JSON.parse(new TextDecoder().decode(numbers)), worker: new CoreWorker(source, module) };
}

/** Calls of the core's functions that would hold up the picture; the worker begins with the first. */
class CoreWorker {
  constructor(source, module) {
    this.source = source;
    this.module = module;
    this.waiting = new Map();
    this.next = 0;
  }

  start() {
    const serve = `${this.source}
      const instance_of = ${instance_of};
      let core = null;
      onmessage = async ({ data }) => {
        if (data.module) { core = instance_of(Feltgate, data.module); return; }
        const module = await core;
        postMessage({ id: data.id, result: module[data.name](...data.args) });
      };`;
    const worker = new Worker(URL.createObjectURL(new Blob([serve], { type: "text/javascript" })));
    worker.postMessage({ module: this.module });
    worker.onmessage = ({ data }) => {
      this.waiting.get(data.id)(data.result);
      this.waiting.delete(data.id);
    };
    return worker;
  }

  call(name, ...args) {
    const id = this.next++;
    this.worker ??= this.start();
    this.worker.postMessage({ id, name, args });
    return new Promise((resolve) => this.waiting.set(id, resolve));
  }
}
