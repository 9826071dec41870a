// A trainee without a haptic device reams the demo in the browser: mouse alone, keys alone, and what happens when the
// hand goes away.
import { expect, type Page, test } from '@playwright/test';

import { CuttableProxy } from './cuttable_proxy';
import { ticksPass } from './rest_as_page';
import { readout, serverForEachTest, untilLive } from './server_for_each_test';

const here = serverForEachTest();

const figure = async (page: Page, id: string) => Number(await page.getByTestId(id).textContent());
const untilHolding = (page: Page) =>
  page.waitForFunction(() => window.__ream.deviceLink === 'holding', null, { timeout: 60_000 });
const state = (page: Page) => page.getByTestId('session-state');
const notice = (page: Page) => page.getByTestId('practice-notice');

async function open(page: Page, url = here.server.url): Promise<void> {
  await page.goto(url);
  await untilLive(page);
}

/** Clicks with the mouse as a hand does: goes there, presses, releases. */
async function clickByMouse(page: Page, id: string): Promise<void> {
  const box = await page.getByTestId(id).boundingBox();
  if (box === null) throw new Error(`nothing to click: ${id}`);
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2, { steps: 4 });
  await page.mouse.down();
  await page.mouse.up();
}

/** The planned entry is in the middle of the picture until the view is moved. */
async function aimAtPlan(page: Page): Promise<void> {
  const box = await page.getByTestId('bone-canvas').boundingBox();
  if (box === null) throw new Error('no picture');
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2, { steps: 6 });
}

async function practise(page: Page): Promise<void> {
  await clickByMouse(page, 'practise');
  await untilHolding(page);
  await expect(state(page)).toHaveAttribute('data-state', 'running');
}

/** Until the reamer cuts, with the button or key that pushes held down already. */
async function untilRemoved(page: Page, mm3: number): Promise<void> {
  await expect.poll(() => figure(page, 'removed-volume'), { timeout: 120_000 }).toBeGreaterThan(mm3);
}

async function expectNoMoreRemoval(page: Page): Promise<void> {
  // The reamer comes to rest on the bone with less than what cuts, 1 N.
  await expect.poll(() => figure(page, 'hand-force'), { timeout: 10_000 }).toBeLessThan(1);
  const session = (await readout(page)).sessionId ?? '';
  await ticksPass(page, session, 400);
  const before = await figure(page, 'removed-volume');
  await ticksPass(page, session, 1500);
  expect(await figure(page, 'removed-volume')).toBe(before);
}

test('the mouse alone reams the demo, and stops reaming when it lets go', async ({ page }) => {
  await open(page);
  await practise(page);
  await clickByMouse(page, 'spindle');
  await aimAtPlan(page);
  await page.mouse.down();
  await untilRemoved(page, 20);
  await expect.poll(() => figure(page, 'depth'), { timeout: 60_000 }).toBeGreaterThan(0);
  const depth = await figure(page, 'depth');
  await expect.poll(() => figure(page, 'depth'), { timeout: 60_000 }).toBeGreaterThan(depth + 0.02);
  expect((await readout(page)).pushN).toBeGreaterThan(20);
  await page.mouse.up();
  expect((await readout(page)).pushN).toBe(0);
  await expectNoMoreRemoval(page);

  // The right button takes the reamer back.
  const touched = (await readout(page)).toolDepthMm ?? 0;
  await page.mouse.down({ button: 'right' });
  await expect.poll(async () => (await readout(page)).toolDepthMm ?? 0, { timeout: 30_000 }).toBeLessThan(touched - 3);
  await page.mouse.up({ button: 'right' });
  await expect(page.getByTestId('health')).toContainText(/Simulation: (OK|running slow)/);
  await clickByMouse(page, 'stop');
  await expect(state(page)).toHaveAttribute('data-state', 'stopped');
  await expect(page.getByTestId('results')).toBeVisible();
  await expect(page.getByTestId('practice-bar')).toBeHidden();
  await expect(page.getByTestId('practise')).toBeEnabled();
});

test('the keys alone ream, pause and stop', { tag: '@full' }, async ({ page }) => {
  await open(page);
  for (let i = 0; i < 30; ++i) {
    await page.keyboard.press('Tab');
    if (await page.getByTestId('practise').evaluate((button) => button === document.activeElement)) break;
  }
  await page.keyboard.press('Enter');
  await untilHolding(page);
  await expect(page.getByTestId('bone-canvas')).toBeFocused();
  await page.keyboard.press('s');
  await expect(page.getByTestId('spindle')).toHaveText('Stop spindle');
  await page.keyboard.down('ArrowRight');
  await expect
    .poll(async () => parseFloat((await page.getByTestId('off-plan').textContent()) ?? ''))
    .toBeGreaterThan(0.5);
  await page.keyboard.up('ArrowRight');
  await page.keyboard.press('Home');
  await page.keyboard.down(' ');
  await untilRemoved(page, 5);
  await page.keyboard.up(' ');
  await expectNoMoreRemoval(page);
  await page.keyboard.press('i');
  await expect(page.getByTestId('irrigation')).toHaveAttribute('aria-pressed', 'true');
  // Without saline the bone is never colder than the body.
  await expect.poll(() => figure(page, 'surface-temperature'), { timeout: 60_000 }).toBeLessThan(35);
  await page.keyboard.press('p');
  await expect(state(page)).toHaveAttribute('data-state', 'paused');
  await expect(notice(page)).toContainText('Paused');
  await page.keyboard.press('p');
  await expect(state(page)).toHaveAttribute('data-state', 'running');
});

test('a page that is left lets go of the reamer', { tag: '@full' }, async ({ page }) => {
  await open(page);
  await practise(page);
  for (const leave of ['blur', 'hide', 'slip'] as const) {
    await clickByMouse(page, 'spindle');
    await aimAtPlan(page);
    await page.mouse.down();
    await expect.poll(() => figure(page, 'hand-force'), { timeout: 60_000 }).toBeGreaterThan(0.5);
    if (leave === 'blur') await page.evaluate(() => window.dispatchEvent(new Event('blur')));
    if (leave === 'hide')
      await page.evaluate(() => {
        Object.defineProperty(document, 'hidden', { configurable: true, get: () => true });
        document.dispatchEvent(new Event('visibilitychange'));
      });
    if (leave === 'slip') await page.mouse.move(1200, 300, { steps: 3 });
    expect((await readout(page)).pushN).toBe(0);
    await expect(page.getByTestId('spindle')).toHaveText('Start spindle');
    await expect(notice(page)).toContainText('Control released');
    await expect(state(page)).toHaveAttribute('data-state', 'paused');
    await expectNoMoreRemoval(page);
    if (leave === 'hide') await page.evaluate(() => delete (document as { hidden?: boolean }).hidden);
    await page.mouse.up();
    await aimAtPlan(page);
    await expect(notice(page)).toBeHidden();
    await expect(state(page)).toHaveAttribute('data-state', 'running');
    expect((await readout(page)).pushN).toBe(0);
  }
});

test('says that the link of the hand is slow or lost, and takes the reamer back when it is there again', async ({
  page,
}) => {
  const proxy = new CuttableProxy(here.server.url);
  await proxy.start();
  try {
    await open(page, proxy.url);
    await practise(page);
    await clickByMouse(page, 'spindle');
    await aimAtPlan(page);
    await page.mouse.down();
    await expect.poll(() => figure(page, 'hand-force'), { timeout: 60_000 }).toBeGreaterThan(0.5);

    proxy.cutDevice();
    await expect(notice(page)).toContainText('Connection lost');
    await expect(page.getByTestId('hand-link')).toHaveText(/Connection lost/);
    expect((await readout(page)).pushN).toBe(0);
    await expect(state(page)).toHaveAttribute('data-state', 'paused');
    await expectNoMoreRemoval(page);
    await page.mouse.up();
    proxy.allowDevice();
    await untilHolding(page);
    await aimAtPlan(page);
    await expect(state(page)).toHaveAttribute('data-state', 'running');
    await expect(notice(page)).toBeHidden();

    proxy.holdDevice(true);
    await expect(notice(page)).toContainText('does not respond to your input');
    await expect(state(page)).toHaveAttribute('data-state', 'paused');
    proxy.holdDevice(false);
    await untilHolding(page);
    await aimAtPlan(page);
    await expect(state(page)).toHaveAttribute('data-state', 'running');
  } finally {
    await page.close();
    await proxy.dispose();
  }
});

test('another page watches, and takes over when it is asked to; a page loaded anew goes on', async ({
  page,
  context,
}) => {
  await open(page);
  await practise(page);
  const steered = (await readout(page)).sessionId;

  await page.reload();
  await untilHolding(page);
  expect((await readout(page)).sessionId).toBe(steered);

  const second = await context.newPage();
  here.watchForErrors(second);
  await open(second);
  expect((await readout(second)).sessionId).toBe(steered);
  expect((await readout(second)).deviceLink).toBeNull();
  await expect(second.getByTestId('practice-bar')).toBeHidden();
  await second.getByTestId('take-over').click();
  await untilHolding(second);
  await expect(page.getByTestId('problem')).toContainText('no longer controls the reamer');
  await expect(page.getByTestId('practice-bar')).toBeHidden();
  expect((await readout(page)).sessionId).toBe(steered);
});
