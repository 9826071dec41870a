// Sessions from the page: paused and begun anew while they run, found, named and watched in the list of all.
import { expect, type Page, test } from '@playwright/test';

import { ticksPass } from './rest_as_page';
import { drawn, readout, serverForEachTest, untilLive } from './server_for_each_test';

const here = serverForEachTest();
const state = (page: Page) => page.getByTestId('session-state');

async function runDemo(page: Page): Promise<string> {
  await page.goto(here.server.url);
  await untilLive(page);
  await page.getByTestId('run-demo').click();
  await page.waitForFunction(() => (window.__ream.lastTick ?? 0) > 500, null, { timeout: 60_000 });
  return (await readout(page)).sessionId ?? '';
}

test('a session is paused, goes on, and begins anew on intact bone as another session', async ({ page }) => {
  const first = await runDemo(page);
  await page.getByTestId('pause-session').click();
  await expect(state(page)).toHaveAttribute('data-state', 'paused');
  const removed = () => page.getByTestId('removed-volume').textContent();
  // The figure may still be of a tick before the pause.
  await ticksPass(page, first, 1500);
  const rested = await removed();
  await ticksPass(page, first, 1500);
  expect(await removed()).toBe(rested);
  await page.getByTestId('pause-session').click();
  await expect(state(page)).toHaveAttribute('data-state', 'running');

  await expect
    .poll(async () => Number(await page.getByTestId('removed-volume').textContent()), { timeout: 90_000 })
    .toBeGreaterThan(60);
  await page.getByTestId('reset-session').click();
  await expect(page.getByTestId('confirm-reset')).toBeFocused();
  await page.getByTestId('confirm-reset').click();
  // The new session reams at once: what it has removed is seen while it is little.
  await page.waitForFunction(
    (before) => {
      const volume = document.querySelector('[data-testid="removed-volume"]')?.textContent;
      return window.__ream.sessionId !== before && window.__ream.live && Number(volume ?? NaN) < 30;
    },
    first,
    { timeout: 60_000 },
  );
  await expect(page.getByTestId('session-labels')).toContainText('attempt 2');
  await page.getByTestId('stop').click();
  await expect(state(page)).toHaveAttribute('data-state', 'stopped');
});

test(
  'a session whose page was closed can be continued or ended by who comes next',
  { tag: '@full' },
  async ({ page, browser }) => {
    await page.goto(here.server.url);
    await untilLive(page);
    await page.getByTestId('practise').click();
    await page.waitForFunction(() => window.__ream.deviceLink === 'holding', null, { timeout: 60_000 });
    await page.close();

    const next = await (await browser.newContext()).newPage();
    here.watchForErrors(next);
    await next.goto(here.server.url);
    await untilLive(next);
    await expect(next.getByTestId('session-left')).toContainText('has left', { timeout: 60_000 });
    await expect(next.getByTestId('take-over')).toHaveText('Continue it');
    await next.getByTestId('stop').click();
    await expect(state(next)).toHaveAttribute('data-state', 'stopped');
    await expect(next.getByTestId('practise')).toBeEnabled();
    await next.context().close();
  },
);

test('sessions are listed, sought, sorted, named and watched', async ({ page }) => {
  const first = await runDemo(page);
  await page.getByTestId('stop').click();
  await expect(state(page)).toHaveAttribute('data-state', 'stopped');
  await page.getByTestId('run-demo').click();
  await page.waitForFunction((before) => window.__ream.sessionId !== before && window.__ream.live, first, {
    timeout: 60_000,
  });
  const second = (await readout(page)).sessionId ?? '';

  await page.getByTestId('to-sessions').click();
  const rows = page.getByTestId('session-table').locator('tbody tr');
  await expect(rows).toHaveCount(2);
  await drawn(page);
  const { framesDrawn } = await readout(page);
  await page.getByTestId(`title-${first}`).click();
  await page.getByTestId(`new-title-${first}`).fill('The very first');
  await page.getByTestId(`save-title-${first}`).click();
  await expect(page.getByTestId(`title-${first}`)).toHaveText('The very first');
  await page.getByTestId('search').fill('very');
  await expect(rows).toHaveCount(1);
  await expect(page.getByTestId(`row-${first}`)).toBeVisible();
  await page.getByTestId('clear-filters').click();
  await expect(rows).toHaveCount(2);
  await page.getByTestId('filter-state').selectOption('live');
  await expect(page.getByTestId('session-count')).toHaveText('1 session');
  await expect(page.getByTestId(`row-${second}`)).toBeVisible();
  await page.getByTestId('filter-state').selectOption('any');
  await page.getByTestId('sort-duration_s').click();
  await expect(page.getByRole('columnheader', { name: 'Duration' })).toHaveAttribute('aria-sort', 'ascending');
  expect((await readout(page)).framesDrawn).toBe(framesDrawn); // the bone changes, and nobody sees it
  await page.getByTestId(`watch-${second}`).click();
  await untilLive(page);
  await page.waitForFunction((before) => window.__ream.framesDrawn > before, framesDrawn);
  expect((await readout(page)).sessionId).toBe(second);
  await page.getByTestId('to-sessions').click();
  await page.getByTestId(`replay-${first}`).click();
  await page.waitForFunction((of) => window.__ream.replayOf === of, first, { timeout: 30_000 });
});
