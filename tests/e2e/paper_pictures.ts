// Makes the pictures of the guides from the program: scripts/write-pictures.
import { resolve } from 'node:path';

import { expect, type Page, test } from '@playwright/test';

import { post, startDemo, ticksPass, untilFinished, untilReady } from './rest_as_page';
import { drawn, serverForEachTest, untilLive } from './server_for_each_test';
import { settled } from './settled';

const here = serverForEachTest();
const fileOf = (name: string) => resolve(__dirname, '../../web/pictures', `${name}.png`);
const patiently = { timeout: 120_000 };

async function open(page: Page, hash: string): Promise<void> {
  await page.goto(`${here.server.url}/${hash}`);
  await untilReady(page, here.server.url);
}

test.describe('of the live page', () => {
  test.use({ viewport: { width: 1280, height: 800 } });
  test('page', async ({ page }) => {
    await open(page, '#');
    await untilLive(page);
    await page.getByTestId('run-demo').click();
    const removedMm3 = async () => Number(await page.getByTestId('removed-volume').textContent());
    await expect.poll(removedMm3, patiently).toBeGreaterThan(250);
    await expect(page.getByTestId('health-dot')).toContainText('OK', patiently);
    await page.screenshot({ path: fileOf('page') });
  });
});

test.describe('of theatre mode', () => {
  test.use({ viewport: { width: 1100, height: 640 } });
  test('theatre', async ({ page }) => {
    await open(page, '#');
    await untilLive(page);
    await page.getByTestId('practice-level').selectOption('exam');
    await page.getByTestId('practise').click();
    await expect(page.getByTestId('trainee-page')).toHaveAttribute('data-theatre', 'true', patiently);
    await page.waitForFunction(() => window.__ream.deviceLink === 'holding', null, patiently);
    await settled(page);
    await page.screenshot({ path: fileOf('theatre') });
  });
});

test('case', async ({ page }) => {
  await open(page, '#/cases/demo');
  await expect(page.getByTestId('surface').first()).toBeVisible(patiently);
  await settled(page);
  await page.screenshot({ path: fileOf('case') });
});

test('review', async ({ page }) => {
  test.setTimeout(400_000);
  await open(page, '#/sessions');
  const whole = await startDemo(page, here.server.url);
  await untilFinished(page, whole);
  const short = await startDemo(page, here.server.url);
  await ticksPass(page, short, 19_000);
  await post(page, `sessions/${short}/stop`);
  await page.goto(`${here.server.url}/#/review/${whole}/${short}`);
  for (const place of [0, 1]) {
    const pane = page.getByTestId(`pane-${place}`);
    await expect(pane).toHaveAttribute('data-position', '0', patiently);
    await pane.getByTestId('after').click();
    await pane.getByTestId('map-plan').click();
    await expect(pane.getByTestId('map-plan')).toHaveAttribute('aria-pressed', 'true', patiently);
  }
  await expect(page.getByTestId('legend')).toBeVisible(patiently);
  await expect(page.getByText(/Preparing the map/)).toHaveCount(0, patiently);
  await drawn(page);
  await settled(page);
  await page.screenshot({ path: fileOf('review') });
});
