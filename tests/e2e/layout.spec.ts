// Pages of lists, cases and reviews, from a phone to a wide screen: nothing sticks out, is covered, or is broken up.
import { expect, type Page, test } from '@playwright/test';

import { assignSession, olga, tom } from './every_page';
import { fullTests } from './full_tests';
import { misplaced } from './misplaced';
import { post, remove, startDemo, untilFinished } from './rest_as_page';
import { logIn, serverForEachTest } from './server_for_each_test';
import { settled } from './settled';

test.use({ actionTimeout: 30_000 });
const here = serverForEachTest([olga, tom]);

const phoneAndDesk = [
  [390, 844],
  [1440, 900],
] as const;
const sizes = fullTests ? ([...phoneAndDesk, [768, 1024], [1920, 1080]] as const) : phoneAndDesk;

/** Something on every page: a session that ended, one that was deleted, a study. */
async function fill(page: Page): Promise<string> {
  const { url } = here.server;
  await page.goto(`${url}/#/`);
  await logIn(page, olga.name);
  await expect(page.getByTestId('dashboard')).toBeVisible();
  const gone = await startDemo(page, url);
  await post(page, `sessions/${gone}/stop`);
  await remove(page, `sessions/${gone}`);
  await post(page, 'studies', { name: 'Who presses?', cases: ['demo'] });
  const kept = await startDemo(page, url);
  await assignSession(page, kept, tom);
  await untilFinished(page, kept);
  return kept;
}

test('lists, cases and reviews fit into windows of any width', async ({ page }, info) => {
  test.setTimeout(600_000);
  const kept = await fill(page);
  for (const [name, hash, testId] of [
    ['review', `#/review/${kept}`, 'score'],
    ['overview', '#/', 'recent'],
    ['sessions', '#/sessions', `row-${kept}`],
    ['trash', '#/trash', 'trash'],
    ['cases', '#/cases', 'cases'],
    ['case', '#/cases/demo', 'surface'],
    ['studies', '#/studies', 'make-study'],
    ['rubrics', '#/rubrics', 'rubric-standard'],
    ['rubric', '#/rubrics/standard', 'criterion-depth_error_mm'],
    ['benchmarks', '#/benchmarks', 'create-benchmark'],
    ['users', '#/users', 'user-tom'],
    ['audit', '#/audit', 'audit'],
  ] as const) {
    await page.goto(`${here.server.url}/${hash}`);
    await expect(page.getByTestId(testId).first()).toBeVisible({ timeout: 60_000 });
    for (const [width, height] of sizes) {
      await page.setViewportSize({ width, height });
      await settled(page);
      await page.screenshot({ path: info.outputPath(`${name}-${width}.png`), fullPage: width < 800 });
      expect.soft(await misplaced(page, 0), `${name} ${width}x${height}`).toEqual([]);
      if (name === 'review') await expectPlayback(page, width);
    }
  }
});

/** Play, timeline and speed are in the picture's pane, and take what is pressed. */
async function expectPlayback(page: Page, width: number): Promise<void> {
  for (const testId of ['play', 'seek', 'speed']) {
    const control = page.getByTestId(testId);
    await control.scrollIntoViewIfNeeded();
    const box = await control.boundingBox();
    expect.soft(box?.height ?? 0, `${testId} at ${width}`).toBeGreaterThanOrEqual(20);
    expect.soft(box?.width ?? 0, `${testId} at ${width}`).toBeGreaterThanOrEqual(testId === 'seek' ? 200 : 40);
    await control.click({ trial: true });
  }
}
