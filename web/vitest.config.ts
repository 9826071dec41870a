import { defineConfig } from 'vitest/config';

// A machine that builds beside the tests may be slow; a test that fails says so long before.
export default defineConfig({
  test: { include: ['test/**/*.test.ts'], environment: 'node', testTimeout: 30_000, hookTimeout: 30_000 },
});
