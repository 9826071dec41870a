// The page against a running server, through Chromium: bone before anything runs, the demo, and a server that dies and
// comes back.
import { gzipSync } from 'node:zlib';

import { expect, type Page, test } from '@playwright/test';

import { compare, darkened, picture } from './pixels';
import { drawn, readout, serverForEachTest, untilLive } from './server_for_each_test';
import { settled } from './settled';

const here = serverForEachTest();

async function openReady(page: Page): Promise<void> {
  await page.goto(here.server.url);
  await untilLive(page);
  await expect(page.getByTestId('link-state')).toHaveText('Ready');
  await expect(page.getByTestId('session-state')).toHaveAttribute('data-state', 'created');
}

test('shows the bone, runs the demo, and the bone, the force and the numbers change', async ({ page }) => {
  await openReady(page);
  const canvas = page.getByTestId('bone-canvas');
  const plot = page.getByTestId('force-plot');

  // Without the reamer in the picture only the bone can change it.
  await page.getByTestId('show-reamer').uncheck();
  await page.getByTestId('view-axis').click();
  await drawn(page);
  const boneBefore = await picture(canvas);
  const plotBefore = await picture(plot);
  const before = await compare(page, boneBefore);
  expect((await readout(page)).blocks).toBeGreaterThan(0);
  expect(before.bone).toBeGreaterThan(before.pixels * 0.05);

  await page.getByTestId('run-demo').click();
  await expect(page.getByTestId('session-state')).toHaveAttribute('data-state', 'running');
  await expect
    .poll(async () => Number(await page.getByTestId('removed-volume').textContent()), { timeout: 90_000 })
    .toBeGreaterThan(5);
  await expect.poll(async () => Number(await page.getByTestId('thrust').textContent())).toBeGreaterThan(0);
  const plotDuring = await picture(plot);
  expect((await compare(page, plotDuring, plotBefore)).changed).toBeGreaterThan(100);

  await expect(page.getByTestId('session-state')).toHaveAttribute('data-state', 'finished', { timeout: 150_000 });
  await expect(page.getByTestId('results')).toBeVisible();
  await drawn(page);
  // Where bone was cut it is told from bone that is whole.
  const reamed = await picture(canvas);
  expect((await compare(page, reamed, boneBefore)).changed).toBeGreaterThan(before.pixels * 0.02);
  expect(await darkened(page, reamed, boneBefore, 3)).toBeGreaterThan(before.bone * 0.2);
  expect(Number(await page.getByTestId('depth').textContent())).toBeGreaterThan(0.1);
  await expect(page.getByTestId('run-demo')).toBeEnabled();
});

test('draws the reamer where it is, and can be stopped', async ({ page }) => {
  await openReady(page);
  const canvas = page.getByTestId('bone-canvas');
  await page.getByTestId('view-side').click();
  const first = await picture(canvas);
  await page.getByTestId('run-demo').click();
  await page.waitForFunction(() => (window.__ream.lastTick ?? 0) > 1000);
  await expect.poll(async () => (await compare(page, await picture(canvas), first)).changed).toBeGreaterThan(200);
  await page.getByTestId('stop').click();
  await expect(page.getByTestId('session-state')).toHaveAttribute('data-state', 'stopped');
});

test('says that the link is lost, and recovers by itself when the server is back', async ({ page }) => {
  await openReady(page);
  await page.getByTestId('run-demo').click();
  await page.waitForFunction(() => (window.__ream.lastTick ?? 0) > 1000);
  const before = await readout(page);

  await here.server.kill();
  const notice = page.getByTestId('link-notice');
  await expect(notice).toContainText('Connection to the simulator lost', { timeout: 3000 });
  await expect(notice).toContainText('It is not live');
  await expect(page.getByTestId('link-state')).toHaveText('Connection lost');
  await expect(page.getByTestId('picture')).toHaveAttribute('data-stale', 'true');
  await expect(page.getByTestId('run-demo')).toBeDisabled();
  expect((await readout(page)).blocks).toBe(before.blocks);
  await expect(notice).toContainText('Trying again');

  await here.server.start();
  await untilLive(page);
  await expect(notice).toBeHidden();
  await expect(page.getByTestId('picture')).toHaveAttribute('data-stale', 'false');
  const after = await readout(page);
  expect(after.serverEpoch).not.toBe(before.serverEpoch);
  expect(after.blocks).toBeGreaterThan(0);
  await expect(page.getByTestId('run-demo')).toBeEnabled();
  await page.getByTestId('run-demo').click();
  await expect(page.getByTestId('session-state')).toHaveAttribute('data-state', 'running');
});

test('a second viewer joins a running session and sees the same', { tag: '@full' }, async ({ page, context }) => {
  await openReady(page);
  await page.getByTestId('run-demo').click();
  await page.waitForFunction(() => (window.__ream.lastTick ?? 0) > 500);
  const second = await context.newPage();
  await second.goto(here.server.url);
  await untilLive(second);
  const [a, b] = [await readout(page), await readout(second)];
  expect(b.sessionId).toBe(a.sessionId);
  expect(b.blocks).toBe(a.blocks);
});

test('is a program of at most 300 kB, packed', async ({ page }) => {
  const packed = new Map<string, Promise<number>>();
  page.on('response', (response) => {
    const name = /assets\/([^/]+\.(?:js|css))$/.exec(response.url())?.[1];
    if (name !== undefined)
      packed.set(
        name,
        response.body().then((body) => gzipSync(body, { level: 9 }).length),
      );
  });
  await page.goto(here.server.url);
  await untilLive(page);
  await settled(page);
  const sizes = await Promise.all([...packed].map(async ([name, size]) => ({ name, bytes: await size })));
  const names = sizes.map(({ name }) => name).join(' ');
  expect(names).toContain('stream_worker');
  // Only where there is no graphics processor.
  expect(names).toContain('surface_simplifier');
  const loaded = sizes.filter(({ name }) => !name.startsWith('surface_simplifier'));
  expect(loaded.reduce((sum, { bytes }) => sum + bytes, 0)).toBeLessThan(300_000);
});
