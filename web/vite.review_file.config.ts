import { resolve } from 'node:path';

import { defineConfig } from 'vite';

import { bundledPackages } from './scripts/bundled_packages.ts';
import { singlePage } from './scripts/single_page.ts';

const { page, worker } = bundledPackages();
const built = (file: string) => resolve(import.meta.dirname, 'public', file);

// The page of review files, dist/review_file.html, into which ream export puts a session. Built after the page itself.
export default defineConfig({
  base: './',
  publicDir: false,
  plugins: [
    ...page,
    singlePage('review_file.html', {
      elements: { 'ream-twin': built('ream-twin.wasm') },
      licences: [built('ream-twin.third-party.txt')],
      others: resolve(import.meta.dirname, 'dist/third-party.json'),
    }),
  ],
  build: {
    target: 'es2022',
    outDir: 'dist',
    emptyOutDir: false,
    chunkSizeWarningLimit: 1800,
    cssCodeSplit: false,
    modulePreload: false,
    assetsInlineLimit: Number.MAX_SAFE_INTEGER,
    rolldownOptions: { input: 'review_file.html', output: { codeSplitting: false } },
  },
  worker: { format: 'iife', plugins: worker },
});
