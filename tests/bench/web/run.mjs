#!/usr/bin/env node
// Measures the page against a `ream serve` of its own (REAM_BIN): run.mjs DATA_FOLDER. The data folder holds cases and
// scripts and goes away. Prints one JSON object of figures; progress goes to stderr.
import { dirname, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

import { runnerImport } from 'vite';

const here = dirname(fileURLToPath(import.meta.url));
const { module } = await runnerImport(resolve(here, 'measure_page.ts'), {
  root: resolve(here, '../../../web'),
  configFile: false,
  logLevel: 'error',
});
console.log(JSON.stringify(await module.measurePage(process.argv[2])));
