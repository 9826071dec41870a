import { writeFileSync } from 'node:fs';

import type { Browser } from '@playwright/test';

import { percentile, log } from './figures';
import { LiveVisit } from './live_visit';
import { scriptOfFrames, type TraceEvent } from './trace';

const watchS = 30;

/** Of the page's script between one animation frame and the next, ms. */
export interface ScriptTime {
  framesPerS: number;
  /** What the script computed: waiting for the drawing process or for a processor is not in it. */
  longestMs: number;
  p99Ms: number;
  medianMs: number;
  /** Computed at a stretch; between two of these the browser may draw. */
  longestUnbrokenMs: number;
  /** By the clock on the wall. */
  longestWallMs: number;
  p99WallMs: number;
}

/**
 * Of somebody who watches a session live, from when the picture is whole. REAM_BENCH_WEB_TRACE names a file for the
 * trace, which Chromium's DevTools show.
 */
export async function scriptTime(browser: Browser, liveUrl: string): Promise<ScriptTime> {
  const visit = await LiveVisit.begin(browser, liveUrl);
  await visit.page.waitForTimeout(1000);
  await browser.startTracing(visit.page, {
    categories: ['devtools.timeline', 'devtools.timeline.frame', 'disabled-by-default-devtools.timeline', 'v8'],
  });
  await visit.page.waitForTimeout(watchS * 1000);
  const trace = JSON.parse((await browser.stopTracing()).toString()) as { traceEvents: TraceEvent[] };
  await visit.end();
  if (process.env.REAM_BENCH_WEB_TRACE !== undefined)
    writeFileSync(process.env.REAM_BENCH_WEB_TRACE, JSON.stringify(trace));
  const frames = scriptOfFrames(trace.traceEvents, liveUrl);
  const computed = frames.map((frame) => frame.computedMs);
  const passed = frames.map((frame) => frame.passedMs);
  const figures = {
    framesPerS: frames.length / watchS,
    longestMs: Math.max(...computed),
    p99Ms: percentile(computed, 0.99),
    medianMs: percentile(computed, 0.5),
    longestUnbrokenMs: Math.max(...frames.map((frame) => frame.unbrokenMs)),
    longestWallMs: Math.max(...passed),
    p99WallMs: percentile(passed, 0.99),
  };
  log(
    `script of ${String(frames.length)} frames: longest ${figures.longestMs.toFixed(1)} ms, at a stretch ${figures.longestUnbrokenMs.toFixed(1)}`,
  );
  return figures;
}
