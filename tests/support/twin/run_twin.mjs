// run_twin.mjs MODULE CAUSES [--hash | --time | --exhaust]: computes a file of causes in this JavaScript engine and prints what came of it as JSON.
// A file that the twin does not take whole is said by its outcome; only a module that cannot run is an error.
import { readFileSync } from 'node:fs';
import { performance } from 'node:perf_hooks';
import { gunzipSync } from 'node:zlib';

const { WebAssembly } = globalThis;

const outcomes = ['agrees', 'damaged', 'differs'];
const [modulePath, causesPath, option] = process.argv.slice(2);
const module = new WebAssembly.Module(readFileSync(modulePath));
const twin = new WebAssembly.Instance(module).exports;
twin._initialize();

if (option === '--exhaust') {
  let outcome = 'went on';
  try {
    twin.twin_input(0xfff00000);
  } catch (error) {
    if (error instanceof WebAssembly.RuntimeError) outcome = 'trapped';
  }
  console.log(JSON.stringify({ outcome }));
  process.exit(0);
}

const file = gunzipSync(readFileSync(causesPath));
const parts = [];
for (let at = 12; at < file.length;) {
  const bytes = file.readUInt32LE(at);
  parts.push(file.subarray(at + 4, at + 4 + bytes));
  at += 4 + bytes;
}

let outcome = 'agrees';
const tickMs = [];
for (const part of parts) {
  const place = twin.twin_input(part.length) >>> 0;
  new Uint8Array(twin.memory.buffer).set(part, place);
  const before = performance.now();
  outcome = outcomes[twin.twin_take()];
  if (part[0] === 3) tickMs.push((performance.now() - before) / part.readUInt32LE(5));
  if (outcome !== 'agrees') break;
}

/** FNV-1a over the surface of every block, so that two engines and the program can be compared. */
let surface = 14695981039346656037n;
const add = (bytes) => {
  for (const byte of bytes) surface = ((surface ^ BigInt(byte)) * 1099511628211n) & 0xffffffffffffffffn;
};
let triangles = 0;
const blocks = twin.twin_find_changed_blocks();
const numbers = new Uint32Array(twin.memory.buffer, twin.twin_blocks_at(), blocks).slice();
for (const block of numbers) {
  const indices = twin.twin_make_surface(block);
  triangles += indices / 3;
  if (option === '--time') continue;
  add(new Uint8Array(twin.memory.buffer, twin.twin_vertices_at(), 8 * twin.twin_vertex_count()));
  add(new Uint8Array(twin.memory.buffer, twin.twin_indices_at(), 4 * indices));
}

const result = {
  outcome,
  agreed_ticks: twin.twin_agreed_ticks(),
  ended: twin.twin_ended() === 1,
  coverage_hash: BigInt.asUintN(64, twin.twin_coverage_hash()).toString(16).padStart(16, '0'),
  triangles,
  surface: surface.toString(16).padStart(16, '0'),
  memory_mb: twin.memory.buffer.byteLength / 1e6,
};
if (option === '--time') {
  tickMs.sort((a, b) => a - b);
  const at = (share) => tickMs[Math.min(tickMs.length - 1, Math.floor(share * tickMs.length))];
  Object.assign(result, { tick_ms: { p50: at(0.5), p99: at(0.99), max: at(1) } });
}
console.log(JSON.stringify(result));
