// A slow line between page and server: at 1 Mbit/s the session is seen; where the line is too slow for that the page
// says how old its news are, and is live again by itself when the line is.
import { expect, type Page, test } from '@playwright/test';

import { serverForEachTest, untilLive } from './server_for_each_test';
import { SlowProxy } from './slow_proxy';

const here = serverForEachTest();
test.use({ actionTimeout: 60_000, viewport: { width: 900, height: 520 } });

const mebibit = 1_000_000;
let line: SlowProxy;
test.beforeEach(async () => {
  line = new SlowProxy(here.server.url, mebibit);
  await line.start();
});
test.afterEach(() => line.dispose());

/** How old what is shown as live is in each of the browser's frames while the session goes on by `ticks`, ms. */
const agesOfNews = (page: Page, ticks: number) =>
  page.evaluate(
    (ticks) =>
      new Promise<number[]>((done) => {
        const ages: number[] = [];
        const until = (window.__ream.lastTick ?? 0) + ticks;
        const look = () => {
          const { live, behindMs, lastTick } = window.__ream;
          if (live) ages.push(behindMs);
          if ((lastTick ?? 0) >= until) done(ages);
          else requestAnimationFrame(look);
        };
        look();
      }),
    ticks,
  );

test('is live at 1 Mbit/s, and says so where it cannot be', async ({ page }, info) => {
  test.setTimeout(300_000);
  await page.goto(line.url, { timeout: 60_000 });
  await page.waitForFunction(() => window.__ream.live, null, { timeout: 120_000 });
  await page.getByTestId('run-demo').click();
  await expect
    .poll(async () => Number(await page.getByTestId('removed-volume').textContent()), { timeout: 90_000 })
    .toBeGreaterThan(5);
  // News keeps coming: what is seen is of the last second or two, or is said not to be.
  const ages = await agesOfNews(page, 6000);
  expect(ages.length).toBeGreaterThan(4);
  expect(Math.max(...ages)).toBeLessThanOrEqual(1500);

  line.bitsPerSecond = mebibit / 20;
  await expect(page.getByTestId('picture')).toHaveAttribute('data-stale', 'true', { timeout: 60_000 });
  await expect(page.getByTestId('link-notice')).toContainText(/too slow|waiting|lost/i);
  await page.screenshot({ path: info.outputPath('too-slow.png') });
  line.bitsPerSecond = 8 * mebibit;
  await untilLive(page);
  await expect(page.getByTestId('link-notice')).toBeHidden();
});
