// What an instructor opens in the morning: who reams, who has reamed, how they come on; and what it says when the server is gone.
import { expect, test } from '@playwright/test';

import { post, startDemo } from './rest_as_page';
import { logIn, serverForEachTest } from './server_for_each_test';
import type { TestUser } from './server_process';

const ines: TestUser = { name: 'ines', role: 'instructor', displayName: 'Ines Instructor' };
const tom: TestUser = { name: 'tom', role: 'trainee', displayName: 'Tom Trainee' };
const ada: TestUser = { name: 'ada', role: 'trainee', displayName: 'Ada Trainee' };
const here = serverForEachTest([{ name: 'olga', role: 'operator', displayName: 'Olga' }, ines, tom, ada]);

test('shows who reams with figures and picture, what has ended with its points, and that demos count for nobody', async ({
  page,
  browser,
}, info) => {
  const context = await browser.newContext();
  const trainee = await context.newPage();
  here.watchForErrors(trainee);
  await trainee.goto(`${here.server.url}/#/`);
  await logIn(trainee, 'tom');
  await expect(trainee.getByTestId('none-live')).toBeVisible();
  await expect(trainee.getByTestId('no-course')).toContainText('Your learning curve is empty');

  // Who teaches begins with it.
  await page.goto(here.server.url);
  await logIn(page, 'ines');
  await expect(page.getByTestId('none-live')).toContainText('No active sessions');
  await expect(page.getByTestId('none-recent')).toBeVisible();
  await expect(page.getByTestId('no-learner')).toContainText('No trainee has a finished session');

  const first = await startDemo(trainee, here.server.url);
  const tile = page.getByTestId(`tile-${first}`);
  // Whoever starts a demo, it is nobody's.
  await expect(tile).toContainText('Demo');
  await expect(tile).not.toContainText('Tom Trainee');
  await expect(tile).toHaveAttribute('data-state', 'running');
  await expect(tile.getByRole('img')).toBeVisible({ timeout: 60_000 });
  await expect(tile).toContainText(/\d\.\d\d of 1\.0 mm/, { timeout: 60_000 });
  await expect(tile).toContainText(/[1-9]\d N/, { timeout: 60_000 });
  await info.attach('dashboard', { body: await page.screenshot(), contentType: 'image/png' });
  // A trainee sees their own only; Ada sees nothing of Tom's.
  await expect(trainee.getByTestId(`tile-${first}`)).toBeVisible();
  await trainee.getByTestId('log-out').click();
  await logIn(trainee, 'ada');
  await expect(trainee.getByTestId('none-live')).toBeVisible();
  await expect(trainee.getByTestId('none-recent')).toBeVisible();
  await context.close();

  await post(page, `sessions/${first}/stop`);
  await expect(tile).toBeHidden();
  await expect(page.getByTestId(`points-${first}`)).toHaveText(/^\d+\.\d$/, { timeout: 60_000 });
  // A demo counts for nobody's course of learning.
  await expect(page.getByTestId('no-learner')).toBeVisible();
  await info.attach('learning', { body: await page.screenshot({ fullPage: true }), contentType: 'image/png' });

  // From here to what an instructor wants of it.
  await expect(page.getByTestId(`recent-${first}`)).toContainText('Demo');
  await expect(page.getByTestId(`recent-${first}`)).not.toContainText('Tom Trainee');
  await expect(page.getByTestId(`recent-review-${first}`)).toHaveAttribute('href', `#/review/${first}`);
  const [report] = await Promise.all([page.waitForEvent('download'), page.getByTestId(`report-${first}`).click()]);
  expect(report.suggestedFilename()).toMatch(/\.pdf$/);
  await page.getByTestId('to-sessions').click();
  const row = page.getByTestId(`row-${first}`);
  await expect(row).toContainText('Demo');
  await expect(page.getByTestId(`points-${first}`)).toHaveText(/^\d+\.\d$/);
  await expect(row).toContainText(/Passed|Failed|Undecided/);
  await expect(page.getByTestId(`review-${first}`)).toBeVisible();
  await expect(page.getByTestId(`report-${first}`)).toBeVisible();
  await page.getByTestId('to-dashboard').click();

  await page.getByTestId(`recent-replay-${first}`).click();
  await page.waitForFunction((of) => window.__ream.replayOf === of, first, { timeout: 60_000 });
});

test('a tile opens the session live; tiles are of before as soon as news stop, and live again by themselves', async ({
  page,
}) => {
  await page.goto(`${here.server.url}/#/`);
  await logIn(page, 'ines');
  await expect(page.getByTestId('none-live')).toBeVisible();
  const id = await startDemo(page, here.server.url);
  await expect(page.getByTestId(`tile-${id}`)).toHaveAttribute('data-stale', 'false');
  await page.getByTestId(`open-${id}`).click();
  await page.waitForFunction((of) => window.__ream.live && window.__ream.sessionId === of, id, { timeout: 60_000 });
  await page.getByTestId('to-dashboard').click();
  await expect(page.getByTestId(`tile-${id}`)).toHaveAttribute('data-stale', 'false');

  await here.server.kill();
  await expect(page.getByTestId('no-updates')).toContainText('not live', { timeout: 3000 });
  await expect(page.getByTestId(`tile-${id}`)).toHaveAttribute('data-stale', 'true');
  await expect(page.getByTestId(`state-${id}`)).toHaveText('not live');
  await here.server.start();
  await expect(page.getByTestId('no-updates')).toBeHidden({ timeout: 60_000 });
  // The killed server's session was closed where it broke off.
  await expect(page.getByTestId(`tile-${id}`)).toBeHidden();
  await expect(page.getByTestId(`recent-${id}`)).toContainText('Interrupted', { timeout: 60_000 });
});
