// What the page says when something is taken from it: the picture, the session, the login, the network. Nothing that was
// shown before is taken for live meanwhile, and what comes back is shown again.
import { expect, type Page, test } from '@playwright/test';

import { compare, picture } from './pixels';
import { post, startDemo } from './rest_as_page';
import { drawn, logIn, readout, serverForEachTest, untilLive } from './server_for_each_test';
import type { TestUser } from './server_process';

const olga: TestUser = { name: 'olga', role: 'operator', displayName: 'Olga Operator' };
const here = serverForEachTest([olga, { name: 'oskar', role: 'operator', displayName: 'Another operator' }]);
// A small picture is drawn quickly, also on a busy machine.
test.use({ actionTimeout: 60_000, viewport: { width: 1000, height: 560 } });
test.describe.configure({ timeout: 300_000 });

type WithContext = Window & { given?: WEBGL_lose_context | null };

/** As a graphics driver that is reset does. */
const losePicture = (page: Page) =>
  page.getByTestId('bone-canvas').evaluate((canvas: HTMLCanvasElement) => {
    const context = canvas.getContext('webgl2')?.getExtension('WEBGL_lose_context');
    (window as WithContext).given = context;
    context?.loseContext();
  });
const givePictureBack = (page: Page) => page.evaluate(() => (window as WithContext).given?.restoreContext());

/** Watches a demo that was paused or stopped after a while: what rests is drawn once. */
async function watchResting(page: Page, how: 'pause' | 'stop'): Promise<string> {
  await page.goto(`${here.server.url}/#/`);
  await logIn(page, 'olga');
  await expect(page.getByTestId('current-user')).toBeVisible();
  const id = await startDemo(page, here.server.url);
  await expect(page.getByTestId(`tile-${id}`)).toContainText(/[1-9] N/, { timeout: 60_000 });
  await post(page, `sessions/${id}/${how}`);
  await page.getByTestId('to-live').click();
  await untilLive(page);
  await expect(page.getByTestId('session-state')).toHaveAttribute('data-state', how === 'stop' ? 'stopped' : 'paused');
  expect((await readout(page)).sessionId).toBe(id);
  return id;
}

test('a picture that the browser takes away is said to be lost, and drawn anew when it is given back', async ({
  page,
}, info) => {
  await watchResting(page, 'stop');
  await page.getByTestId('view-axis').click();
  // It stands before the bone, nearer or farther as the session was stopped.
  await page.getByTestId('show-reamer').uncheck();
  await drawn(page);
  const canvas = page.getByTestId('bone-canvas');
  const before = await picture(canvas);
  expect((await compare(page, before)).bone).toBeGreaterThan(5000);

  await losePicture(page);
  await expect(page.getByTestId('picture-lost')).toContainText('The picture has stopped');
  await expect(page.getByTestId('picture')).toHaveAttribute('data-stale', 'true');
  await expect(canvas).toBeHidden();
  await page.screenshot({ path: info.outputPath('picture-lost.png') });
  const frames = (await readout(page)).framesDrawn;
  await page.getByTestId('view-plan').click();
  await drawn(page);
  expect((await readout(page)).framesDrawn).toBe(frames);
  await page.getByTestId('view-axis').click();

  await givePictureBack(page);
  await expect(page.getByTestId('picture-lost')).toBeHidden();
  await expect(page.getByTestId('picture')).toHaveAttribute('data-stale', 'false');
  await expect.poll(async () => (await compare(page, await picture(canvas), before)).changed).toBeLessThan(200);
});

test('who steers lets go when the picture is lost', { tag: '@full' }, async ({ page }) => {
  await page.goto(here.server.url);
  await logIn(page, 'olga');
  await page.getByTestId('to-live').click();
  await page.getByTestId('practise').click({ timeout: 120_000 });
  await page.waitForFunction(() => window.__ream.deviceLink === 'holding', null, { timeout: 60_000 });
  await page.keyboard.press('s');
  await page.keyboard.down(' ');
  await expect.poll(async () => (await readout(page)).pushN).toBeGreaterThan(5);
  await losePicture(page);
  await expect.poll(async () => (await readout(page)).pushN).toBe(0);
  await expect(page.getByTestId('picture-lost')).toContainText('Control released', { timeout: 60_000 });
  await expect(page.getByTestId('session-state')).toHaveAttribute('data-state', 'paused');
  await givePictureBack(page);
  await expect(page.getByTestId('practice-notice')).toContainText('Control released');
  await page.keyboard.up(' ');
});

test(
  'a session that rests is not live when the network is cut, and is again when it is back',
  { tag: '@full' },
  async ({ page, context }) => {
    await watchResting(page, 'pause');
    await context.setOffline(true);
    await expect(page.getByTestId('link-notice')).toContainText('It is not live');
    await expect(page.getByTestId('picture')).toHaveAttribute('data-stale', 'true');
    await page.getByTestId('to-dashboard').click();
    await expect(page.getByTestId('no-updates')).toContainText('does not respond');
    await context.setOffline(false);
    await expect(page.getByTestId('no-updates')).toBeHidden();
    await page.getByTestId('to-live').click();
    await untilLive(page);
  },
);

test('a session that is deleted is said to be so, and a login that has ended asks for another', async ({ page }) => {
  const id = await watchResting(page, 'stop');
  const deletion = () =>
    page.evaluate(async (session) => {
      const visitor = (await (await fetch('/api/v1/login')).json()) as { csrf_token: string };
      const headers = { 'x-csrf-token': visitor.csrf_token };
      return (await fetch(`/api/v1/sessions/${session}`, { method: 'DELETE', headers })).status;
    }, id);
  await expect.poll(deletion, { timeout: 30_000 }).toBe(204);
  await expect(page.getByTestId('problem')).toContainText(`Session ${id}`);
  await expect(page.getByTestId('problem')).toContainText('has been deleted');
  expect((await readout(page)).sessionId).not.toBe(id);

  await page.getByTestId('to-dashboard').click();
  await expect(page.getByTestId('none-live')).toBeVisible();
  here.server.command('user', 'disable', 'olga');
  await expect(page.getByTestId('login-problem')).toContainText('Your login has ended');
  await expect(page.getByTestId('dashboard')).toBeHidden();
});
