// A recorded session seen again through the page: opened from the list, moved about in, and never taken for live.
import { expect, type Page, test } from '@playwright/test';

import { compare, picture } from './pixels';
import { drawn, readout, serverForEachTest, untilLive } from './server_for_each_test';
import { settled } from './settled';

const here = serverForEachTest();

/** Reams for some seconds of the demo, stops, and gives the session's id. */
async function recordDemo(page: Page, ticks: number): Promise<string> {
  await page.goto(here.server.url);
  await untilLive(page);
  await page.getByTestId('run-demo').click();
  await page.waitForFunction((until) => (window.__ream.lastTick ?? 0) > until, ticks, { timeout: 90_000 });
  await page.getByTestId('stop').click();
  await expect(page.getByTestId('session-state')).toHaveAttribute('data-state', 'stopped');
  return (await readout(page)).sessionId ?? '';
}

async function openReplay(page: Page, sessionId: string): Promise<void> {
  await page.getByTestId('sessions').locator('summary').click();
  await page.getByTestId(`replay-${sessionId}`).click();
  await page.waitForFunction((of) => window.__ream.replayOf === of && window.__ream.positionTicks !== null, sessionId, {
    timeout: 30_000,
  });
  await expect(page.getByTestId('picture')).toHaveAttribute('data-stale', 'false');
}

/** Until the stream has told how things stand as they are after `ms`. */
async function telemetryArrived(page: Page, ms = 0): Promise<void> {
  const before = (await readout(page)).telemetryMs ?? 0;
  await page.waitForFunction((after) => (window.__ream.telemetryMs ?? 0) > after, before + ms, { timeout: 30_000 });
}

async function seek(page: Page, seconds: number): Promise<void> {
  await page.getByTestId('seek').fill(String(seconds));
  await page.waitForFunction((ticks) => window.__ream.positionTicks === ticks, Math.round(seconds * 1000));
  // What is told next is of later than all that the jump changed.
  await telemetryArrived(page);
  await settled(page);
}

test('a recorded session is opened from the list, moved about in, and says that it is no live one', async ({
  page,
}) => {
  const sessionId = await recordDemo(page, 16_000);
  const canvas = page.getByTestId('bone-canvas');
  const plot = page.getByTestId('force-plot');
  await page.getByTestId('show-reamer').uncheck();
  await page.getByTestId('view-axis').click();
  await drawn(page);
  const removedLive = Number(await page.getByTestId('removed-volume').textContent());
  expect(removedLive).toBeGreaterThan(5);

  await openReplay(page, sessionId);
  await expect(page.getByTestId('link-state')).toHaveText('Replay');
  await expect(page.getByTestId('replay-badge')).toBeVisible();
  await expect(page.getByTestId('run-demo')).toBeHidden();
  expect((await readout(page)).live).toBe(false);
  // A thin layer goes: few pixels change by much, but none where nothing is gone.
  const durationS = Number(await page.getByTestId('seek').getAttribute('max'));
  expect(durationS).toBeGreaterThan(16);

  await drawn(page);
  const atStart = await picture(canvas);
  await seek(page, durationS);
  const atEnd = await picture(canvas);
  expect((await compare(page, atEnd, atStart)).changed).toBeGreaterThan(40);
  await expect.poll(async () => Number(await page.getByTestId('removed-volume').textContent())).toBe(removedLive);
  const forceAtEnd = await picture(plot);

  await seek(page, 5);
  const atFive = await picture(canvas);
  expect((await compare(page, atFive, atEnd)).changed).toBeGreaterThan(40);
  expect((await compare(page, await picture(plot), forceAtEnd)).changed).toBeGreaterThan(100);
  await seek(page, durationS);
  await expect.poll(async () => (await compare(page, await picture(plot), forceAtEnd)).changed).toBeLessThan(5);
  await expect.poll(async () => (await compare(page, await picture(canvas), atEnd)).changed).toBeLessThan(5);
  await seek(page, 5);
  await expect.poll(async () => (await compare(page, await picture(canvas), atFive)).changed).toBeLessThan(5);
  await seek(page, 0);
  await expect.poll(async () => (await compare(page, await picture(canvas), atStart)).changed).toBeLessThan(5);

  await page.getByTestId('speed').selectOption('4');
  await page.getByTestId('play').click();
  await page.waitForFunction(() => (window.__ream.positionTicks ?? 0) > 3000, null, { timeout: 20_000 });
  await page.getByTestId('play').click();
  await expect(page.getByTestId('play')).toHaveAttribute('data-playing', 'false');
  const rested = (await readout(page)).positionTicks;
  await telemetryArrived(page, 700);
  expect((await readout(page)).positionTicks).toBe(rested);

  await page.getByTestId('leave-replay').click();
  await page.waitForFunction(() => window.__ream.live, null, { timeout: 30_000 });
  await expect(page.getByTestId('replay-badge')).toBeHidden();
  await expect(page.getByTestId('link-state')).toHaveText(/^(Stopped|Finished)$/);
});

test('two viewers of one replay see the same, found by its address', { tag: '@full' }, async ({ page, context }) => {
  const sessionId = await recordDemo(page, 6000);
  await openReplay(page, sessionId);
  const second = await context.newPage();
  await second.goto(page.url());
  await second.waitForFunction(
    (of) => window.__ream.replayOf === of && window.__ream.positionTicks !== null,
    sessionId,
  );
  await seek(second, 4);
  await page.waitForFunction(() => window.__ream.positionTicks === 4000);
  const [a, b] = [await readout(page), await readout(second)];
  expect(b.sessionId).toBe(a.sessionId);
  expect(b.blocks).toBe(a.blocks);
  await second.getByTestId('play').click();
  await page.waitForFunction(() => (window.__ream.positionTicks ?? 0) > 4500);
});
