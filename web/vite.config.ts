import { defineConfig } from 'vite';

import { bundledPackages } from './scripts/bundled_packages.ts';

const { page, worker } = bundledPackages();

// `npm run dev` shows the page with live reload against a server already running on port 8080.
export default defineConfig({
  base: './',
  plugins: page,
  build: {
    target: 'es2022',
    outDir: 'dist',
    emptyOutDir: true,
    // The page about the API is large and apart.
    chunkSizeWarningLimit: 1800,
    rollupOptions: { input: ['index.html', 'api.html'] },
  },
  worker: { format: 'es', plugins: worker },
  server: {
    host: '127.0.0.1',
    proxy: { '/api': { target: 'http://127.0.0.1:8080', ws: true } },
  },
});
