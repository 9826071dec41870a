import type { Browser } from '@playwright/test';

import { log } from './figures';
import { LiveVisit } from './live_visit';

/** The page tells of its last 20 s. */
const windowS = 20;
const windows = 2;

export interface HandDelay {
  /** From the sample of the hand to the picture of it, as the page says; the worst of the windows. */
  p95Ms: number;
  removedMm3: number;
}

/** Somebody practises with the keys: spindle on, pushing. */
export async function handDelay(browser: Browser, liveUrl: string): Promise<HandDelay> {
  const { page } = await LiveVisit.begin(browser, liveUrl);
  await page.getByTestId('practise').click();
  await page.waitForFunction(() => window.__ream.deviceLink === 'holding');
  await page.keyboard.press('s');
  await page.keyboard.down(' ');
  const readings: number[] = [];
  for (let i = 0; i < windows; ++i) {
    await page.waitForTimeout(windowS * 1000);
    readings.push((await page.evaluate(() => window.__ream.handLatencyMs)) ?? NaN);
  }
  await page.keyboard.up(' ');
  const removedMm3 = Number(await page.getByTestId('removed-volume').textContent());
  await page.getByTestId('stop').click();
  await page.waitForFunction(() => window.__ream.sessionState === 'stopped');
  await page.context().close();
  log(
    `hand to picture, p95: ${readings.map((ms) => ms.toFixed(0)).join(', ')} ms; ${removedMm3.toFixed(1)} mm3 removed`,
  );
  if (!(removedMm3 > 0)) throw new Error('the hand on the page did not ream');
  return { p95Ms: Math.max(...readings), removedMm3 };
}
