// Somebody who has never seen the page follows the tutorial to the letter, by mouse and by keys, skips it, goes too
// deep, or ends it early.
import { AxeBuilder } from '@axe-core/playwright';
import { expect, type Page, test } from '@playwright/test';

import { readout, serverForEachTest, untilLive } from './server_for_each_test';
import {
  againUntilLeft,
  covered,
  harder,
  middle,
  named,
  namedKeys,
  reamByKeys,
  tutorial,
  untilNamedDepth,
  untilStep,
} from './tutorial_hand';

const here = serverForEachTest();
test.setTimeout(300_000);

const withinMm = 0.3;

async function open(page: Page): Promise<void> {
  await page.goto(here.server.url);
  await untilLive(page);
}

const untilHolding = (page: Page) =>
  page.waitForFunction(() => window.__ream.deviceLink === 'holding', null, { timeout: 60_000 });

/** The page says that all is done, and the server's own measure that the plan was reached. */
async function expectReached(page: Page): Promise<void> {
  await untilStep(page, 'finished');
  await expect(page.getByTestId('tutorial-do')).toContainText('You have reamed the demo to the planned depth');
  await expect(page.getByTestId('results')).toBeVisible();
  const id = (await readout(page)).sessionId ?? '';
  const metrics = (await (await page.request.get(`${here.server.url}/api/v1/sessions/${id}/metrics`)).json()) as {
    depth_error_mm: number;
  };
  expect(metrics.depth_error_mm).toBeLessThanOrEqual(withinMm);
}

async function serious(page: Page): Promise<string[]> {
  const { violations } = await new AxeBuilder({ page }).include('.tutorial').include('.run').analyze();
  return violations.flatMap(({ id, nodes }) => nodes.map(({ target }) => `${id}: ${target.join(' ')}`));
}

test('by mouse the demo is reamed to its plan', async ({ page }, info) => {
  await open(page);
  const look = async (name: string) => {
    expect(await covered(page), name).toEqual([]);
    await page.screenshot({ path: info.outputPath(`${name}.png`) });
  };
  // Somebody without a session is offered the tutorial first.
  await expect(page.getByTestId('tutorial-offer')).toBeVisible();
  await page.getByTestId('tutorial-start').click();
  await untilHolding(page);
  await untilStep(page, 'look');
  await expect(page.getByTestId('tutorial-progress')).toHaveText('Step 1 of 8');
  await expect(page.getByTestId('guide')).toBeHidden();
  const { x, y } = await middle(page);

  expect(await named(page)).toEqual(['Ctrl', 'left button', 'Ctrl', 'wheel']);
  await page.mouse.move(x + 60, y + 40, { steps: 4 });
  await page.keyboard.down('Control');
  await page.mouse.down();
  await page.mouse.move(x - 60, y + 40, { steps: 6 });
  await page.mouse.up();
  await page.mouse.wheel(0, -100);
  await page.keyboard.up('Control');
  await untilStep(page, 'aim');
  await expect(page.getByTestId('tutorial-done')).toContainText('looked around');
  await look('aim');

  await expect(page.getByTestId('tutorial-do')).toContainText('Move the pointer');
  await page.mouse.move(x, y, { steps: 8 });
  await untilStep(page, 'spindle');
  for (const name of await named(page)) await page.getByRole('button', { name, exact: true }).click();
  await untilStep(page, 'touch');

  expect(await named(page)).toEqual(['left button']);
  await page.mouse.move(x, y, { steps: 8 });
  await page.mouse.down();
  await untilStep(page, 'press');
  await look('press');
  expect(await named(page)).toEqual(['left button', 'wheel']);
  await againUntilLeft(page, 'press', () => harder(page, () => page.mouse.wheel(0, -100)));
  await untilStep(page, 'stop');
  expect(await named(page)).toEqual(['left button']);
  await untilNamedDepth(page);
  await page.mouse.up();
  await untilStep(page, 'withdraw');
  // Nothing is looked at while the reamer cuts towards the plan: on a slow computer it would cut too deep.
  await look('withdraw');
  expect(await named(page)).toEqual(['right button']);
  await page.mouse.down({ button: 'right' });
  await untilStep(page, 'result');
  await page.mouse.up({ button: 'right' });
  await look('result');
  expect(await named(page)).toEqual(['Stop']);
  await tutorial(page).getByRole('button', { name: 'Stop', exact: true }).click();
  await expectReached(page);
  await expect(page.getByTestId('alarm-depth')).toBeHidden();
  await look('finished');

  // It is remembered, and stays at hand.
  await page.getByRole('button', { name: 'Close', exact: true }).click();
  await expect(tutorial(page)).toBeHidden();
  await page.reload();
  await untilLive(page);
  await expect(page.getByTestId('tutorial-start')).toBeVisible();
  await expect(page.getByTestId('tutorial-offer')).toBeHidden();
});

test('by keys alone the demo is reamed to its plan', { tag: '@full' }, async ({ page }) => {
  await open(page);
  await page.getByTestId('tutorial-start').focus();
  await page.keyboard.press('Enter');
  await untilHolding(page);
  await untilStep(page, 'look');
  await expect(page.getByTestId('bone-canvas')).toBeFocused();
  for (const colorScheme of ['dark', 'light'] as const) {
    await page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
    await expect(page.locator('html')).toHaveAttribute('data-theme', colorScheme);
    expect(await serious(page), colorScheme).toEqual([]);
  }

  await reamByKeys(page);
  const [shift = '', tab = '', enter = ''] = await namedKeys(page);
  await page.keyboard.press(`${shift}+${tab}`);
  await expect(page.getByTestId('tutorial-stop')).toBeFocused();
  await page.keyboard.press(enter);
  await expectReached(page);
  await expect(tutorial(page).getByRole('link')).toBeFocused();
});

test('who goes too deep is told so, and starts again on intact bone', { tag: '@full' }, async ({ page }, info) => {
  await open(page);
  await page.getByTestId('tutorial-start').click();
  await untilHolding(page);
  await untilStep(page, 'look');
  await page.keyboard.press('Home');
  await page.keyboard.down(' ');
  // Against the order of the steps: it says so, and how to go on.
  const astray = page.getByTestId('tutorial-astray');
  await expect(astray).toContainText('already on the bone', { timeout: 60_000 });
  await expect(astray.locator('kbd').first()).toHaveText('Space');
  await page.keyboard.up(' ');
  await expect(astray).toBeHidden();

  await page.keyboard.press('s');
  await page.keyboard.press('i');
  for (let i = 0; i < 12; ++i) await page.keyboard.press('+');
  await page.keyboard.down(' ');
  await expect(astray).toContainText('more than 0.3 mm past the plan', { timeout: 150_000 });
  await expect(astray).toContainText('Start again');
  await expect(page.getByTestId('alarm-depth')).toBeVisible();
  await page.keyboard.up(' ');
  await page.keyboard.down('b');
  // The alarm ends with what it is about; the honest sentence stays.
  await expect(page.getByTestId('alarm-depth')).toBeHidden();
  await page.keyboard.up('b');
  await expect(astray).toContainText('more than 0.3 mm past the plan');
  await page.screenshot({ path: info.outputPath('too-deep.png') });

  const before = (await readout(page)).sessionId;
  await page.getByTestId('tutorial-again').click();
  // The session that ends is kept first.
  await page.waitForFunction((id) => window.__ream.sessionId !== id, before, { timeout: 120_000 });
  await untilHolding(page);
  await untilStep(page, 'look');
  await expect(astray).toBeHidden();
  await expect(page.getByTestId('depth')).toHaveText('0.00');
});

test('who has ended it early starts again, in a session that runs', { tag: '@full' }, async ({ page }) => {
  await open(page);
  await page.getByTestId('tutorial-start').click();
  await untilHolding(page);
  await untilStep(page, 'look');
  const before = (await readout(page)).sessionId;
  await page.getByTestId('stop').click();
  await expect(page.getByTestId('tutorial-astray')).toContainText('ended before the last step');
  await page.getByTestId('tutorial-again').click();
  await page.waitForFunction((id) => window.__ream.sessionId !== id, before, { timeout: 120_000 });
  await untilHolding(page);
  await expect(page.getByTestId('session-state')).toHaveAttribute('data-state', 'running');
  await untilStep(page, 'look');
  await expect(page.getByTestId('tutorial-astray')).toBeHidden();
});

test('it is skipped by one key, and no longer offered first', async ({ page }) => {
  await open(page);
  await expect(page.getByTestId('tutorial-offer')).toBeVisible();
  await page.getByTestId('tutorial-start').click();
  await untilHolding(page);
  await untilStep(page, 'look');
  for (const [width, height] of [
    [390, 844],
    [768, 1024],
    [1280, 720],
  ] as const) {
    await page.setViewportSize({ width, height });
    await expect.poll(() => covered(page), `${width}`).toEqual([]);
  }
  // The key closes what it is pressed in first.
  await page.getByTestId('sections').click();
  await page.getByTestId('bone-opacity').press('Escape');
  await expect(page.getByTestId('sections-panel')).toBeHidden();
  await expect(tutorial(page)).toBeVisible();
  await page.keyboard.press('Escape');
  await expect(tutorial(page)).toBeHidden();
  // The reamer stays in the hand, with the short guide.
  await expect(page.getByTestId('guide')).toBeVisible();
  expect((await readout(page)).deviceLink).toBe('holding');
  await page.getByTestId('stop').click();
  await expect(page.getByTestId('tutorial-start')).toBeVisible();
  await expect(page.getByTestId('tutorial-offer')).toBeHidden();
  await expect(page.getByTestId('practise')).not.toHaveClass(/run-second/);
});

test('who does not want it is not asked again', { tag: '@full' }, async ({ page }) => {
  await open(page);
  await page.getByRole('button', { name: 'Not now' }).click();
  await expect(page.getByTestId('tutorial-offer')).toBeHidden();
  await page.reload();
  await untilLive(page);
  await expect(page.getByTestId('practise')).toBeEnabled();
  await expect(page.getByTestId('tutorial-offer')).toBeHidden();
});
