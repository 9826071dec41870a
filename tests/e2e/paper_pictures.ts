// Makes the pictures of the guides from the program: scripts/write-pictures.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';

import { expect, type Locator, type Page, test } from '@playwright/test';

import type { Landmarks } from '../../web/src/wire/rest_types';
import { post, startDemo, ticksPass, untilFinished, untilReady } from './rest_as_page';
import { drawn, serverForEachTest, untilLive } from './server_for_each_test';
import { program } from './server_process';
import { settled } from './settled';

const here = serverForEachTest();
const fileOf = (name: string) => resolve(__dirname, '../../web/pictures', `${name}.png`);
const patiently = { timeout: 120_000 };
/** So often an arrow key is pressed until the scapula is seen from behind, its spine and tip in front. */
const turnsAround = 33;
const marginPx = 12;

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

/** A case of a whole scapula with all its landmarks, open at their step; the view that is named fills the page. */
async function openLandmarks(page: Page, walch: 'A1' | 'B2', enlarged: 'axial' | 'surface'): Promise<void> {
  const folder = mkdtempSync(join(tmpdir(), 'ream-phantom-'));
  const series = join(folder, 'ct');
  const options = ['--type', walch, '--spacing-mm', '0.8', '--format', 'nrrd', '--side', 'right'];
  execFileSync(program, ['phantom', '--out', series, ...options]);
  const wear = walch === 'B2' ? 'biconcave face' : 'whole scapula';
  here.server.command('import', join(series, 'ct.nrrd'), '--out', 'shoulder', '--side', 'right', '--name', wear);
  const placed = JSON.parse(readFileSync(join(series, 'landmarks.json'), 'utf8')) as Landmarks;
  // Of a face that is not biconcave no class has been chosen yet.
  const data = walch === 'B2' ? placed : { ...placed, walch: undefined };
  rmSync(folder, { recursive: true, force: true });
  const saved = await page.request.put(`${here.server.url}/api/v1/cases/shoulder/landmarks`, { data });
  expect(saved.ok(), await saved.text()).toBe(true);
  await open(page, '#/cases/shoulder');
  await expect(page.getByTestId('surface')).toHaveAttribute('data-state', 'shown', patiently);
  const head = page.getByTestId('step-landmarks').locator('h2 button');
  if ((await head.getAttribute('aria-expanded')) !== 'true') await head.click();
  await expect(page.getByTestId('measures')).toHaveAttribute('data-fresh', 'true', patiently);
  await page.getByTestId(`enlarge-${enlarged}`).click();
}

/** The view beside the steps, as high as what is to be seen of these: no line is cut in two. */
async function besideSteps(page: Page, first: Locator, last: Locator, file: string): Promise<void> {
  const views = page.locator('main');
  const boxOf = async (of: Locator) => (await of.boundingBox()) ?? { x: 0, y: 0, width: 0, height: 0 };
  const [from, to, shown] = [await boxOf(first), await boxOf(last), await boxOf(views)];
  const { width, height } = page.viewportSize() ?? { width: 0, height: 0 };
  const wanted = to.y + to.height - from.y + marginPx;
  await page.setViewportSize({ width, height: Math.round(height + wanted - shown.height) });
  await first.evaluate((element) => element.scrollIntoView({ block: 'start' }));
  await settled(page);
  const [left, right] = [await boxOf(views), await boxOf(page.locator('.steps'))];
  const clip = { x: left.x, y: left.y, width: right.x + right.width - left.x, height: left.height };
  await page.screenshot({ path: fileOf(file), clip });
}

async function press(page: Page, view: string, keys: Record<string, number>): Promise<void> {
  await page.getByTestId(view).focus();
  for (const [key, times] of Object.entries(keys)) for (let i = 0; i < times; ++i) await page.keyboard.press(key);
  await page.evaluate(() => (document.activeElement as HTMLElement).blur());
  await page.mouse.move(0, 0);
}

test.describe('of landmarks', () => {
  test.use({ viewport: { width: 1040, height: 860 } });

  test('landmarks on the surface', async ({ page }) => {
    await openLandmarks(page, 'A1', 'surface');
    await page.getByTestId('landmark-glenoid_centre_mm').click();
    await page.getByTestId('look-glenoid').click();
    const [first, last] = [page.getByTestId('step-segment'), page.getByTestId('biconcavity')];
    await besideSteps(page, first, last, 'landmarks-glenoid');
    await page.getByTestId('landmark-trigonum_mm').click();
    await page.getByTestId('look-front').click();
    await press(page, 'surface-canvas', { ArrowRight: turnsAround });
    await settled(page);
    await page.locator('section.view').screenshot({ path: fileOf('landmarks-scapula') });
  });

  test('landmarks of a biconcave face', async ({ page }) => {
    await openLandmarks(page, 'B2', 'axial');
    await page.getByTestId('show-labels').uncheck();
    await page.getByTestId('landmark-biconcavity_1').click();
    await press(page, 'slice-axial', { '+': 5 });
    const [first, last] = [page.getByTestId('biconcavity'), page.getByTestId('measures')];
    await besideSteps(page, first, last, 'landmarks-slice');
  });
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
