// Sessions from the page: paused and begun anew while they run, found, named and watched in the list of all.
import { expect, type Page, test } from '@playwright/test';

import { readout, serverForEachTest, untilLive } from './server_for_each_test';

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
  const rested = await removed();
  await page.waitForTimeout(1500);
  expect(await removed()).toBe(rested);
  await page.getByTestId('pause-session').click();
  await expect(state(page)).toHaveAttribute('data-state', 'running');

  await expect
    .poll(async () => Number(await page.getByTestId('removed-volume').textContent()), { timeout: 90_000 })
    .toBeGreaterThan(20);
  await page.getByTestId('reset-session').click();
  await expect(page.getByTestId('really-reset')).toBeFocused();
  await page.getByTestId('really-reset').click();
  await page.waitForFunction((before) => window.__ream.sessionId !== before && window.__ream.live, first, {
    timeout: 60_000,
  });
  await expect(page.getByTestId('session-labels')).toContainText('attempt 2');
  await expect.poll(async () => Number(await page.getByTestId('removed-volume').textContent())).toBeLessThan(5);
  await page.getByTestId('stop').click();
  await expect(state(page)).toHaveAttribute('data-state', 'stopped');
});

test('sessions are listed, sought, sorted, named and watched', async ({ page, context }) => {
  const first = await runDemo(page);
  await page.getByTestId('stop').click();
  await expect(state(page)).toHaveAttribute('data-state', 'stopped');
  await page.getByTestId('run-demo').click();
  await page.waitForFunction((before) => window.__ream.sessionId !== before && window.__ream.live, first, {
    timeout: 60_000,
  });
  const second = (await readout(page)).sessionId ?? '';

  const list = await context.newPage();
  here.watchForErrors(list);
  await list.goto(`${here.server.url}/#/sessions`);
  const rows = list.getByTestId('session-table').locator('tbody tr');
  await expect(rows).toHaveCount(2);
  await list.getByTestId(`title-${first}`).click();
  await list.getByTestId(`new-title-${first}`).fill('The very first');
  await list.getByTestId(`save-title-${first}`).click();
  await expect(list.getByTestId(`title-${first}`)).toHaveText('The very first');
  await list.getByTestId('search').fill('very');
  await expect(rows).toHaveCount(1);
  await expect(list.getByTestId(`row-${first}`)).toBeVisible();
  await list.getByTestId('clear-filters').click();
  await expect(rows).toHaveCount(2);
  await list.getByTestId('filter-state').selectOption('live');
  await expect(list.getByTestId('session-count')).toHaveText('1 session');
  await expect(list.getByTestId(`row-${second}`)).toBeVisible();
  await list.getByTestId('filter-state').selectOption('any');
  await list.getByTestId('sort-duration_s').click();
  await expect(list.getByRole('columnheader', { name: 'Length' })).toHaveAttribute('aria-sort', 'ascending');
  await list.getByTestId(`watch-${second}`).click();
  await untilLive(list);
  expect((await readout(list)).sessionId).toBe(second);
  await list.goto(`${here.server.url}/#/sessions`);
  await list.getByTestId(`replay-${first}`).click();
  await list.waitForFunction((of) => window.__ream.replayOf === of, first, { timeout: 30_000 });
});
