// Where practice starts: case and level, what each level gives, and what others say while somebody reams.
import { AxeBuilder } from '@axe-core/playwright';
import { expect, type Page, test } from '@playwright/test';

import { misplaced } from './misplaced';
import { readout, serverForEachTest, untilLive } from './server_for_each_test';

const here = serverForEachTest();
const windows = [
  [1280, 800],
  [768, 1024],
  [390, 844],
] as const;
const level = (page: Page) => page.getByTestId('practice-level');
const comments = (page: Page) => page.getByTestId('comment-notice');

async function open(page: Page): Promise<void> {
  await page.goto(here.server.url);
  await untilLive(page);
}

async function practise(page: Page, name: string): Promise<void> {
  await level(page).selectOption(name);
  await page.getByTestId('practise').click();
  await page.waitForFunction(() => window.__ream.deviceLink === 'holding', null, { timeout: 60_000 });
}

/** Waits until the page shows a number. */
async function offPlanMm(page: Page): Promise<number> {
  let shown = NaN;
  const read = async () => (shown = parseFloat((await page.getByTestId('off-plan').textContent()) ?? ''));
  await expect.poll(async () => Number.isFinite(await read())).toBe(true);
  return shown;
}

async function stop(page: Page): Promise<void> {
  await page.getByTestId('stop').click();
  await expect(page.getByTestId('session-state')).toHaveAttribute('data-state', 'stopped');
  await page.getByTestId('close-result').click();
}

test('each level gives less, and the one chosen last is remembered', async ({ page }, info) => {
  await open(page);
  await expect(level(page)).toHaveValue('guided');
  await expect(page.getByTestId('practice-case')).toHaveValue('demo');
  await expect(page.getByTestId('practice-reamer')).toContainText('Reamer:');
  for (const [width, height] of windows) {
    await page.setViewportSize({ width, height });
    for (const colorScheme of ['light', 'dark'] as const) {
      await page.emulateMedia({ colorScheme });
      await page.getByTestId('practice-chooser').scrollIntoViewIfNeeded();
      await page.screenshot({ path: info.outputPath(`chooser-${width}-${colorScheme}.png`) });
    }
    expect(await misplaced(page, 20), `${width}`).toEqual([]);
  }
  expect((await new AxeBuilder({ page }).include('.run').analyze()).violations).toEqual([]);
  await page.setViewportSize({ width: 1280, height: 720 });
  await page.emulateMedia({ colorScheme: 'light' });

  await practise(page, 'guided');
  await expect(page.getByTestId('guide')).toBeVisible();
  expect(await offPlanMm(page)).toBeLessThan(0.1);
  await stop(page);

  await practise(page, 'free');
  await expect(page.getByTestId('guide')).toBeVisible();
  await expect(page.getByTestId('push-level')).toBeVisible();
  expect(await offPlanMm(page)).toBeGreaterThan(1.9);
  await stop(page);

  await practise(page, 'own');
  const started = await offPlanMm(page);
  expect(started).toBeGreaterThan(2.9);
  await expect(page.getByTestId('guide')).toHaveCount(0);
  await expect(page.getByTestId('push-level')).toHaveCount(0);
  await expect(page.getByTestId('gauge-version')).toBeVisible();
  await page.screenshot({ path: info.outputPath('own.png') });
  // Loaded anew, the page starts from the same place at the same level.
  await page.reload();
  await page.waitForFunction(() => window.__ream.deviceLink === 'holding', null, { timeout: 60_000 });
  await expect(page.getByTestId('push-level')).toHaveCount(0);
  expect(await offPlanMm(page)).toBeCloseTo(started, 1);
  await stop(page);
  await expect(level(page)).toHaveValue('own');
});

test(
  'a comment of somebody else reaches who reams, also in theatre',
  { tag: '@full' },
  async ({ page, request }, info) => {
    await open(page);
    const say = async (words: string) => {
      const { sessionId } = await readout(page);
      const answer = await request.post(`${here.server.url}/api/v1/sessions/${sessionId ?? ''}/annotations`, {
        data: { words, author: 'Ines Instructor' },
      });
      expect(answer.status()).toBe(201);
    };
    await practise(page, 'guided');
    await expect(page.getByTestId('comment-notices')).toHaveAttribute('role', 'status');
    await page.getByTestId('live-annotation').fill('My own words');
    await page.getByTestId('keep-live-annotation').click();
    await expect(page.getByTestId('annotations')).toContainText('My own words');
    await say('Tilt the reamer a little more to the front.');
    await expect(comments(page)).toHaveText(/Ines Instructor: Tilt the reamer/);
    await page.getByRole('button', { name: 'Dismiss comment' }).click();
    await expect(comments(page)).toHaveCount(0);
    await expect(page.getByTestId('bone-canvas')).toBeFocused();
    for (const [width, height] of windows) {
      await page.setViewportSize({ width, height });
      await say(`Press less, and let the reamer do the work. ${width}`);
      await expect(comments(page).last()).toContainText(`${width}`);
      await page.getByTestId('bone-canvas').scrollIntoViewIfNeeded();
      await page.screenshot({ path: info.outputPath(`comment-${width}.png`) });
    }
    await page.setViewportSize({ width: 1280, height: 720 });
    await stop(page);

    await practise(page, 'exam');
    await expect(page.getByTestId('trainee-page')).toHaveAttribute('data-theatre', 'true');
    // All that a touch screen needs is there.
    for (const id of ['spindle', 'irrigation', 'withdraw', 'pause', 'end-theatre'])
      await expect(page.getByTestId(id)).toBeVisible();
    await page.setViewportSize({ width: 390, height: 844 });
    await say('Stop now.');
    await expect(comments(page)).toHaveText(/Stop now/);
    for (const colorScheme of ['light', 'dark'] as const) {
      await page.emulateMedia({ colorScheme });
      await page.screenshot({ path: info.outputPath(`exam-390-${colorScheme}.png`) });
    }
    expect((await new AxeBuilder({ page }).include('.trainee-page').analyze()).violations).toEqual([]);
    await expect(page.getByTestId('withdraw')).toBeInViewport({ ratio: 1 });
    await page.setViewportSize({ width: 1280, height: 720 });
    await page.screenshot({ path: info.outputPath('exam-1280.png') });
    await page.getByTestId('end-theatre').click();
  },
);
