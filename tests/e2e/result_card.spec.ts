// What somebody sees when a session ends: what it was worth, what to do better, and the ways on.
import { AxeBuilder } from '@axe-core/playwright';
import { expect, type Page, test } from '@playwright/test';

import { readout, serverForEachTest, untilLive } from './server_for_each_test';

const here = serverForEachTest();
const card = (page: Page) => page.getByTestId('result-card');
const state = (page: Page) => page.getByTestId('session-state');

/** Nothing of it is outside of the window. */
async function expectInWindow(page: Page): Promise<void> {
  const box = await card(page).boundingBox();
  const { width, height } = page.viewportSize() ?? { width: 0, height: 0 };
  expect(box?.x).toBeGreaterThanOrEqual(0);
  expect(box?.y).toBeGreaterThanOrEqual(0);
  expect((box?.x ?? NaN) + (box?.width ?? NaN)).toBeLessThanOrEqual(width);
  expect((box?.y ?? NaN) + (box?.height ?? NaN)).toBeLessThanOrEqual(height);
}

test('a session that was reamed ends with its points, advice and the ways on', async ({ page }, info) => {
  await page.goto(here.server.url);
  await untilLive(page);
  await page.getByTestId('run-demo').click();
  await expect
    .poll(async () => Number(await page.getByTestId('removed-volume').textContent()), { timeout: 90_000 })
    .toBeGreaterThan(10);
  const { sessionId } = await readout(page);
  await page.getByTestId('stop').click();
  await expect(card(page)).toBeFocused();
  await expect(page.getByRole('region', { name: 'Session ended' })).toBeVisible();
  await expect(page.getByTestId('result-mark')).toHaveText(/^(Passed|Failed|Not assessed).*of 100 points$/);
  await expect(card(page)).toContainText('Pass mark: 70 points');
  await expect(page.getByTestId('result-advice').locator('li').first()).toBeVisible();
  expect(await page.getByTestId('result-advice').locator('li').count()).toBeLessThanOrEqual(3);
  await expect(page.getByTestId('result-review')).toHaveAttribute('href', `#/review/${sessionId ?? ''}`);
  await expect(page.getByTestId('result-report')).toBeVisible();
  // The bone is seen as it was left, and nothing of the reamer is told any more.
  await expect(page.getByTestId('show-reamer')).not.toBeChecked();
  for (const id of ['hand-force', 'thrust', 'vibration-plot-now', 'spindle-speed', 'version-now'])
    await expect(page.getByTestId(id)).toHaveText('–');
  await expect(page.getByTestId('alarms')).toBeEmpty();
  await expect(page.getByTestId('reset-session')).toHaveCount(0);

  for (const [width, height] of [
    [1280, 720],
    [390, 844],
    [1920, 1080],
  ] as const) {
    await page.setViewportSize({ width, height });
    await card(page).focus();
    await expectInWindow(page);
    for (const colorScheme of ['light', 'dark'] as const) {
      await page.emulateMedia({ colorScheme });
      await page.screenshot({ path: info.outputPath(`card-${width}-${colorScheme}.png`) });
    }
  }
  expect((await new AxeBuilder({ page }).include('.result-card').analyze()).violations).toEqual([]);
  await page.setViewportSize({ width: 1280, height: 720 });

  await card(page).press('Escape');
  await expect(card(page)).toBeHidden();
  await page.screenshot({ path: info.outputPath('closed.png') });
  await page.getByTestId('show-result').click();
  const download = page.waitForEvent('download', { timeout: 120_000 });
  await page.getByTestId('result-report').click();
  expect((await download).suggestedFilename()).toMatch(/\.pdf$/);
});

test(
  'without contact it says so; trying again is the same case at the same level',
  { tag: '@full' },
  async ({ page }, info) => {
    await page.goto(here.server.url);
    await untilLive(page);
    await page.getByTestId('practice-level').selectOption('exam');
    await page.getByTestId('practise').click();
    await page.waitForFunction(() => window.__ream.deviceLink === 'holding', null, { timeout: 60_000 });
    const first = (await readout(page)).sessionId;
    await page.getByTestId('end-theatre').click();
    await expect(page.getByTestId('result-untouched')).toHaveText('No bone was removed.');
    await page.screenshot({ path: info.outputPath('untouched.png') });
    await page.getByTestId('practice-level').selectOption('guided');
    const made = page.waitForRequest((request) => request.method() === 'POST' && request.url().endsWith('/sessions'));
    await page.getByTestId('try-again').click();
    expect((await made).postDataJSON()).toMatchObject({ case: 'demo', theatre: true });
    await page.waitForFunction(
      (before) => window.__ream.sessionId !== before && window.__ream.deviceLink === 'holding',
      first,
      { timeout: 60_000 },
    );
    await expect(page.getByTestId('trainee-page')).toHaveAttribute('data-theatre', 'true');
    await expect(card(page)).toHaveCount(0);
  },
);

test('a session that ended before the page was opened is not judged unasked', async ({ page }) => {
  await page.goto(here.server.url);
  await untilLive(page);
  await page.getByTestId('run-demo').click();
  await page.waitForFunction(() => (window.__ream.lastTick ?? 0) > 300, null, { timeout: 60_000 });
  await page.getByTestId('stop').click();
  await expect(card(page)).toBeVisible();
  await page.reload();
  await expect(state(page)).toHaveAttribute('data-state', 'stopped');
  await expect(page.getByTestId('show-result')).toBeVisible();
  await expect(card(page)).toHaveCount(0);
});
