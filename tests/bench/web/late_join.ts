import type { Browser } from '@playwright/test';

import { median, log } from './figures';
import { LiveVisit } from './live_visit';

const visits = 7;

/** Medians, ms. */
export interface LateJoin {
  /** From asking for the stream to the whole picture. */
  joinedMs: number;
  /** From asking for the page's address to the whole picture. */
  openedMs: number;
}

/** Opens the live page of a session under way, again and again. */
export async function lateJoin(browser: Browser, liveUrl: string): Promise<LateJoin> {
  const joined: number[] = [];
  const opened: number[] = [];
  for (let i = 0; i < visits; ++i) {
    const visit = await LiveVisit.begin(browser, liveUrl);
    joined.push(visit.joinedAfterMs);
    opened.push(visit.openedAfterMs);
    await visit.end();
  }
  log(`joined after ${joined.map((ms) => ms.toFixed(0)).join(', ')} ms`);
  return { joinedMs: median(joined), openedMs: median(opened) };
}
