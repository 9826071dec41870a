// The picture in a headset, from the live page and from a review. The headset is emulated: it speaks WebXR as a real one
// does, and its head and hands are moved by the test.
import { expect, type Page, test } from '@playwright/test';
import { readFileSync } from 'node:fs';
import type { XRDevice } from 'iwer';

import { compare, pictureOfBone } from './pixels';
import { startDemo } from './rest_as_page';
import { serverForEachTest, untilLive } from './server_for_each_test';

const here = serverForEachTest();
test.use({ actionTimeout: 60_000, viewport: { width: 1000, height: 560 } });
// Both eyes are drawn at every frame, in software.
test.setTimeout(420_000);
test.describe.configure({ timeout: 300_000 });

type Emulated = Window & { worn?: XRDevice; IWER: typeof import('iwer') };

/** From here on the page finds a headset. */
async function withHeadset(page: Page): Promise<void> {
  await page.addInitScript(readFileSync(require.resolve('iwer/build/iwer.min.js'), 'utf8'));
  await page.addInitScript(() => {
    const { IWER } = window as unknown as Emulated;
    const device = new IWER.XRDevice(IWER.metaQuest3, { stereoEnabled: true });
    device.installRuntime({ forceInstall: true });
    (window as unknown as Emulated).worn = device;
  });
}

const bone = (page: Page) => pictureOfBone(page.getByTestId('bone-canvas').first());
const untilDrawnMore = async (page: Page) => {
  const before = await page.evaluate(() => window.__ream.framesDrawn);
  await page.waitForFunction((drawn) => window.__ream.framesDrawn > drawn + 3, before, { timeout: 60_000 });
};

/** The emulated headset spreads the picture over the page, so that no pointer reaches it. */
async function takeOff(page: Page): Promise<void> {
  await page.getByTestId('headset').dispatchEvent('click');
  await expect(page.getByTestId('headset')).toHaveText('Headset');
}

test(
  'the live bone is seen in a headset, grabbed and made larger, and the page goes on afterwards',
  { tag: '@full' },
  async ({ page }, info) => {
    await withHeadset(page);
    await page.goto(here.server.url);
    await untilLive(page);
    await page.getByTestId('headset').click();
    await expect(page.getByTestId('headset')).toHaveText('End headset');
    await untilDrawnMore(page);
    const worn = await bone(page);
    await page.screenshot({ path: info.outputPath('worn.png') });

    // A step aside shows another side of it.
    await page.evaluate(() => (window as unknown as Emulated).worn?.position.set(0.2, 1.6, 0));
    await untilDrawnMore(page);
    const aside = await bone(page);
    expect((await compare(page, aside, worn)).changed).toBeGreaterThan(2000);

    // The trigger grabs it: it goes where the hand goes.
    await page.evaluate(() => {
      const hand = (window as unknown as Emulated).worn?.controllers.right;
      hand?.updateButtonValue('trigger', 1);
    });
    await untilDrawnMore(page);
    await page.evaluate(() => {
      const hand = (window as unknown as Emulated).worn?.controllers.right;
      hand?.position.set(0.05, 1.7, -0.4);
    });
    await untilDrawnMore(page);
    await page.evaluate(() => (window as unknown as Emulated).worn?.controllers.right?.updateButtonValue('trigger', 0));
    const carried = await bone(page);
    expect((await compare(page, carried, aside)).changed).toBeGreaterThan(2000);
    await page.screenshot({ path: info.outputPath('carried.png') });

    // What is not of this moment says so, also to who sees nothing else.
    await here.server.kill();
    await expect(page.getByTestId('picture')).toHaveAttribute('data-stale', 'true');
    await untilDrawnMore(page);
    await page.screenshot({ path: info.outputPath('not-live.png') });
    await takeOff(page);
    await here.server.start();
    await untilLive(page);
  },
);

test('a recorded session is seen in a headset', { tag: '@full' }, async ({ page }, info) => {
  await withHeadset(page);
  await page.goto(here.server.url);
  await untilLive(page);
  const id = await startDemo(page, here.server.url);
  await expect
    .poll(async () => Number(await page.getByTestId('removed-volume').textContent()), { timeout: 90_000 })
    .toBeGreaterThan(20);
  await page.getByTestId('stop').click();
  await expect(page.getByTestId('session-state')).toHaveAttribute('data-state', 'stopped', { timeout: 60_000 });
  await page.goto(`${here.server.url}/#/review/${id}`);
  await expect(page.getByTestId('bone-canvas')).toBeVisible({ timeout: 60_000 });
  // Also where the headset is put on before the bone has come.
  await page.getByTestId('headset').click();
  await expect(page.getByTestId('headset')).toHaveText('End headset');
  await expect
    .poll(async () => (await compare(page, await bone(page))).bone, { timeout: 60_000 })
    .toBeGreaterThan(2000);
  await page.screenshot({ path: info.outputPath('review-worn.png') });
  await takeOff(page);
});

test('where there is no headset none is offered', async ({ page }) => {
  await page.goto(here.server.url);
  await untilLive(page);
  await expect(page.getByTestId('headset')).toBeHidden();
});
