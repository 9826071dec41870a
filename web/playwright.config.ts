import { defineConfig } from '@playwright/test';

// Chromium of the system, with the software WebGL that is fastest without a screen.
export default defineConfig({
  testDir: '../tests/e2e',
  globalSetup: '../tests/e2e/kept_demo.ts',
  outputDir: 'test-results',
  timeout: 180_000,
  // What is waited for comes late on a busy machine.
  expect: { timeout: 20_000 },
  // Drawing in software takes every processor: of two browsers at once each test takes more than twice as long.
  workers: 1,
  // A test that passes at the second try has found a fault.
  retries: 0,
  reporter: [['list']],
  use: {
    viewport: { width: 1280, height: 720 },
    launchOptions: {
      executablePath: process.env.REAM_CHROMIUM ?? '/usr/bin/chromium',
      env: { ...(process.env as Record<string, string>), LIBGL_ALWAYS_SOFTWARE: '1', EGL_PLATFORM: 'surfaceless' },
      args: [
        '--use-gl=angle',
        '--use-angle=gl-egl',
        '--ignore-gpu-blocklist',
        '--no-sandbox',
        '--disable-quic',
        '--no-first-run',
        '--disable-background-networking',
        '--disable-component-update',
        '--disable-sync',
      ],
    },
    screenshot: 'only-on-failure',
  },
});
