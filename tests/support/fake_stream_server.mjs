#!/usr/bin/env node
// Speaks the REST and stream protocol of `ream serve` over a small made-up bone, so that the page can be worked on and
// its tests run without the C++ server: fake_stream_server.mjs serve [--port 0] [--json]; other options are ignored.
import { dirname, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

import { runnerImport } from 'vite';

const here = dirname(fileURLToPath(import.meta.url));
const { module } = await runnerImport(resolve(here, 'fake_stream/server.ts'), {
  root: resolve(here, '../../web'),
  configFile: false,
  logLevel: 'error',
});
const options = process.argv.slice(2);
const portAt = options.indexOf('--port');
const url = await module.serve(portAt < 0 ? 8080 : Number(options[portAt + 1]), resolve(here, '../../web/dist'));
console.log(options.includes('--json') ? JSON.stringify({ url }) : `fake server on ${url}`);
