// What the live page can show of the bone: cut-away, transparent bone, sections and the surgeon's view, by mouse and by keys.
import { expect, type Page, test } from '@playwright/test';

import { compare, pictureOfBone } from './pixels';
import { drawn, readout, serverForEachTest, untilLive } from './server_for_each_test';

const here = serverForEachTest();

const canvas = (page: Page) => page.getByTestId('bone-canvas');

const bone = (page: Page) => pictureOfBone(canvas(page));

async function open(page: Page): Promise<void> {
  await page.goto(here.server.url);
  await untilLive(page);
  await drawn(page);
}

/** Until two pictures that follow each other are the same. */
async function untilStill(page: Page): Promise<void> {
  let before = await bone(page);
  await expect
    .poll(
      async () => {
        const now = before;
        before = await bone(page);
        return (await compare(page, before, now)).changed;
      },
      { timeout: 60_000, intervals: [500] },
    )
    .toBe(0);
}

/** Pixels that another look changes. */
async function changed(page: Page, before: string): Promise<number> {
  await drawn(page);
  return (await compare(page, await bone(page), before)).changed;
}

test('cuts the bone along the reamer and along the planes of the body, and remembers it', async ({ page }, info) => {
  await open(page);
  await page.getByTestId('run-demo').click();
  await expect
    .poll(async () => Number(await page.getByTestId('removed-volume').textContent()), { timeout: 90_000 })
    .toBeGreaterThan(5);
  await page.getByTestId('stop').click();
  await expect(page.getByTestId('session-state')).toHaveAttribute('data-state', 'stopped');
  await drawn(page);
  const whole = await bone(page);

  await page.getByTestId('cut-away').click();
  await expect(page.getByTestId('cut-away')).toHaveAttribute('aria-pressed', 'true');
  await expect.poll(() => changed(page, whole)).toBeGreaterThan(3000);
  await page.screenshot({ path: info.outputPath('cut-away.png') });
  await page.keyboard.press('c');
  await expect.poll(() => changed(page, whole)).toBeLessThan(200);

  await page.getByTestId('see-through').click();
  await expect.poll(() => changed(page, whole)).toBeGreaterThan(3000);
  await page.screenshot({ path: info.outputPath('see-through.png') });
  await page.keyboard.press('x');

  await page.getByTestId('sections').click();
  const offset = page.getByTestId('section-axial-offset');
  await page.getByTestId('section-axial').check();
  const cut = await changed(page, whole);
  expect(cut).toBeGreaterThan(3000);
  await page.screenshot({ path: info.outputPath('section.png') });
  const atEntry = await bone(page);
  await offset.focus();
  for (let i = 0; i < 12; ++i) await page.keyboard.press('ArrowRight');
  await expect(offset).toHaveValue('6');
  await expect.poll(() => changed(page, atEntry)).toBeGreaterThan(1000);
  await page.keyboard.press('[');
  await expect(offset).toHaveValue('5');
  await page.getByTestId('section-axial-flip').click();
  await expect(page.getByTestId('section-axial-flip')).toHaveAttribute('aria-pressed', 'true');

  const drawing = page.getByTestId('tool-drawing');
  await expect(drawing.locator('option:checked')).toHaveText('Automatic (low now)');
  const plain = await bone(page);
  const { triangles } = await readout(page);
  await drawing.selectOption('full');
  await expect.poll(() => changed(page, plain)).toBeGreaterThan(1000);
  // The rest of the scapula, too: more than the whole reamer has.
  await expect
    .poll(async () => (await readout(page)).triangles, { timeout: 30_000 })
    .toBeGreaterThan(triangles + 30_000);
  await page.screenshot({ path: info.outputPath('full.png') });
  // Shadows: much of the picture is another.
  await untilStill(page);
  const full = await bone(page);
  await drawing.selectOption('fine');
  await expect.poll(() => changed(page, full)).toBeGreaterThan(3000);
  await page.screenshot({ path: info.outputPath('fine.png') });

  await page.reload();
  await untilLive(page);
  await page.getByTestId('sections').click();
  await expect(drawing).toHaveValue('fine');
  await expect(page.getByTestId('section-axial')).toBeChecked();
  await expect(page.getByTestId('section-axial-offset')).toHaveValue('5');
  await expect(page.getByTestId('see-through')).toHaveAttribute('aria-pressed', 'false');
});

test(
  'glides to the surgeon’s view and gives the view back to the hand that turns it',
  { tag: '@full' },
  async ({ page }, info) => {
    await open(page);
    await untilStill(page);
    const own = await bone(page);
    await page.keyboard.press('v');
    await expect(page.getByTestId('trainee-camera')).toHaveAttribute('aria-pressed', 'true');
    await expect.poll(() => changed(page, own)).toBeGreaterThan(3000);
    await untilStill(page);
    await page.screenshot({ path: info.outputPath('surgeon.png') });
    const surgeon = await bone(page);
    await canvas(page).focus();
    await page.keyboard.press('ArrowLeft');
    await expect(page.getByTestId('trainee-camera')).toHaveAttribute('aria-pressed', 'false');
    await untilStill(page);
    await expect.poll(() => changed(page, surgeon)).toBeGreaterThan(1000);
    await page.getByTestId('view-plan').click();
    await expect.poll(() => changed(page, own)).toBeLessThan(200);
  },
);

test('says in one word whether the simulation keeps up, and sounds only when asked', async ({ page }, info) => {
  await open(page);
  const dot = page.getByTestId('health-dot');
  // The figures behind it are for who looks for them.
  await expect(page.getByTestId('force-scale')).toHaveText(/^\d+$/);
  await expect(page.getByTestId('force-scale')).toBeHidden();
  await expect(page.getByTestId('latency')).toHaveText('–');
  const sound = page.getByTestId('sound');
  await expect(sound).toHaveText('Turn sound on');
  await sound.click();
  await expect(sound).toHaveText('Turn sound off');
  expect((await page.evaluate(() => window.__ream.sound)).motorGain).toBe(0);
  await page.getByTestId('run-demo').click();
  await expect.poll(async () => Number(await page.getByTestId('latency').textContent())).toBeGreaterThan(0);
  await expect(dot).toContainText(/Simulation: (OK|running slow)/);
  await expect(page.getByTestId('live-strip')).not.toContainText(/ ms|ticks|p95/);
  await expect
    .poll(async () => (await page.evaluate(() => window.__ream.sound)).trackGain, { timeout: 90_000 })
    .toBeGreaterThan(0);
  await page.screenshot({ path: info.outputPath('strip.png') });

  // Nothing is heard, and no figure stands, once nothing is heard of the server.
  await here.server.kill();
  await expect(page.getByTestId('picture')).toHaveAttribute('data-stale', 'true');
  expect(await page.evaluate(() => window.__ream.sound)).toMatchObject({ motorGain: 0, cuttingGain: 0, trackGain: 0 });
  await expect(page.getByTestId('latency')).toHaveText('–');
  await expect(dot).toContainText('Simulation: connection lost');
  await page.keyboard.press('m');
  await expect(sound).toHaveText('Turn sound on');
});

test('the trainee’s view is the picture alone, and steers', async ({ page }, info) => {
  await open(page);
  await page.getByTestId('practise').click();
  await page.waitForFunction(() => window.__ream.deviceLink === 'holding', null, { timeout: 60_000 });
  // Of a hand on this page it is known how long it takes to be seen.
  await expect(page.getByTestId('health')).toContainText('Input delay');
  await expect.poll(async () => Number(await page.getByTestId('latency').textContent())).toBeGreaterThan(0);
  await page.getByTestId('to-trainee').click();
  await expect(page.getByTestId('trainee-page')).toHaveAttribute('data-theatre', 'false');
  await expect(page.getByTestId('force-plot')).toBeHidden();
  const box = await canvas(page).boundingBox();
  expect(box).toMatchObject({ width: 1280, height: 720 });
  await page.getByTestId('spindle').click();
  await expect(page.getByTestId('spindle')).toHaveText('Stop spindle');
  expect((await page.evaluate(() => window.__ream)).deviceLink).toBe('holding');
  await page.screenshot({ path: info.outputPath('trainee.png') });
  await page.getByTestId('leave-trainee').click();
  await expect(page.getByTestId('practice-bar')).toBeVisible();
  expect((await page.evaluate(() => window.__ream)).deviceLink).toBe('holding');
});

test('in theatre there is nothing but the bone, an opaque reamer, sound and force', async ({ page }, info) => {
  const sent: { theatre?: boolean }[] = [];
  page.on('request', (request) => {
    if (request.method() === 'POST' && request.url().endsWith('/sessions'))
      sent.push(request.postDataJSON() as { theatre?: boolean });
  });
  await open(page);
  await page.getByTestId('cut-away').click();
  await page.getByTestId('practice-level').selectOption('exam');
  const eye = async () => {
    const { target, towardsEye, distanceMm } = (await readout(page)).eye;
    return [target.x, target.y, target.z, towardsEye.x, towardsEye.y, towardsEye.z, distanceMm];
  };
  const eyeBefore = await eye();
  await page.getByTestId('practise').click();
  const theatre = page.getByTestId('trainee-page');
  await expect(theatre).toHaveAttribute('data-theatre', 'true');
  expect(sent.at(-1)?.theatre).toBe(true);
  await page.waitForFunction(() => window.__ream.deviceLink === 'holding', null, { timeout: 60_000 });
  for (const id of ['gauge-version', 'depth', 'force-plot', 'alarms', 'cut-away', 'leave-trainee', 'live-strip'])
    await expect(page.getByTestId(id)).toHaveCount(0);
  await expect(page.getByTestId('sound')).toBeVisible();
  await untilStill(page);
  await page.screenshot({ path: info.outputPath('theatre.png') });
  // Around the wound all is covered: nowhere does the page's background show through, which is another in the dark.
  const inLight = await bone(page);
  await page.emulateMedia({ colorScheme: 'dark' });
  await expect(page.locator('html')).toHaveAttribute('data-theme', 'dark');
  expect(await changed(page, inLight)).toBe(0);
  await page.emulateMedia({ colorScheme: 'light' });
  // A push is not given: it grows as long as it lasts, and passes what a plain one stops at.
  const pushed = async (newtons: number) => {
    await page.waitForFunction((n) => window.__ream.pushN > n, newtons, { timeout: 20_000 });
  };
  await page.locator('canvas').first().hover();
  await page.mouse.down();
  await pushed(5);
  await pushed(60);
  // It falls as it rose, not at once.
  const falling = page.evaluate(
    () =>
      new Promise<number[]>((resolve) => {
        const seen: number[] = [];
        const look = () => {
          seen.push(window.__ream.pushN);
          if (window.__ream.pushN > 0) requestAnimationFrame(look);
          else resolve(seen);
        };
        look();
      }),
  );
  await page.mouse.up();
  expect((await falling).filter((newtons) => newtons > 1 && newtons < 50).length).toBeGreaterThan(0);
  await page.keyboard.press('c');
  await page.evaluate(() => (window.location.hash = ''));
  await expect(theatre).toHaveAttribute('data-theatre', 'true');
  await page.getByTestId('end-theatre').click();
  await expect(page.getByTestId('gauge-version')).toBeVisible();
  await expect(page.getByTestId('cut-away')).toHaveAttribute('aria-pressed', 'true');
  // The bone is seen from where it was seen before.
  await expect
    .poll(async () => Math.max(...(await eye()).map((value, i) => Math.abs(value - (eyeBefore[i] ?? NaN)))))
    .toBeLessThan(0.5);
});

test(
  'shows the CT beside the picture, with the outline of the reamer, once it is asked for',
  { tag: '@full' },
  async ({ page }, info) => {
    const loaded: string[] = [];
    page.on('request', (request) => loaded.push(request.url()));
    await open(page);
    expect(loaded.filter((url) => /live_slices|volume\/slices/.test(url))).toEqual([]);
    await page.getByTestId('practise').click();
    await page.waitForFunction(() => window.__ream.deviceLink === 'holding', null, { timeout: 60_000 });
    await page.getByTestId('slices').click();
    for (const name of ['axial', 'coronal', 'sagittal']) {
      const slice = page.getByTestId(`live-slice-${name}`);
      await expect(slice).toBeVisible();
      /** Of pixels that are not black, and of those in the colours of plan and reamer. */
      const seen = () =>
        slice.evaluate((element: HTMLCanvasElement) => {
          const { width, height } = element;
          const { data } = element.getContext('2d')?.getImageData(0, 0, width, height) ?? { data: [] };
          const counts = { grey: 0, reamer: 0, plan: 0 };
          for (let i = 0; i < data.length; i += 4) {
            const [r = 0, g = 0, b = 0] = data.slice(i, i + 3);
            if (r > 60 && r === g && g === b) ++counts.grey;
            if (r > 200 && g > 160 && b < 140) ++counts.reamer;
            if (r < 90 && g > 170 && b > 120) ++counts.plan;
          }
          return counts;
        });
      await expect.poll(async () => (await seen()).grey).toBeGreaterThan(500);
      await expect.poll(async () => (await seen()).plan).toBeGreaterThan(5);
      if (name !== 'sagittal') await expect.poll(async () => (await seen()).reamer).toBeGreaterThan(20);
    }
    await page.screenshot({ path: info.outputPath('slices.png') });
    await page.keyboard.press('t');
    await expect(page.getByTestId('live-slices')).toHaveCount(0);
  },
);

test(
  'nothing stands over the place that is aimed at, and the depth is beside it',
  { tag: '@full' },
  async ({ page }, info) => {
    await open(page);
    await page.getByTestId('practise').click();
    await page.waitForFunction(() => window.__ream.deviceLink === 'holding', null, { timeout: 60_000 });
    /** The planned entry is in the middle of the picture. */
    const atEntry = () =>
      canvas(page).evaluate((element) => {
        const box = element.getBoundingClientRect();
        const top = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
        return top === element ? 'the picture' : (top?.className ?? 'nothing');
      });
    for (const [width, height] of [
      [1280, 720],
      [1024, 768],
      [1920, 1080],
      [390, 844],
    ] as const) {
      await page.setViewportSize({ width, height });
      await canvas(page).scrollIntoViewIfNeeded();
      await page.screenshot({ path: info.outputPath(`live-${width}.png`) });
      await expect(page.getByTestId('depth')).toBeInViewport();
      if (width < 1000) continue;
      expect(await atEntry(), `${width}`).toBe('the picture');
      await page.getByTestId('sections').click();
      await expect(page.getByTestId('section-axial')).toBeVisible();
      await drawn(page);
      await page.screenshot({ path: info.outputPath(`sections-${width}.png`) });
      expect(await atEntry(), `${width} with sections`).toBe('the picture');
      await page.getByTestId('sections').click();
    }
  },
);
