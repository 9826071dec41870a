// A reamer far below the subchondral plate has cut spongy bone: how that looks, by the quality of the picture.
import { spawnSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { expect, type Page, test } from '@playwright/test';

import { expectKeptLook } from './kept_pictures';
import { luminanceSpread } from './pixels';
import { drawn, serverForEachTest } from './server_for_each_test';
import { settled } from './settled';

const here = serverForEachTest();
const session = 'deepbone';
const script = {
  device: 'poses',
  duration_s: 10,
  poses: [
    { t_s: 0, position_mm: [0, 0, -1] },
    { t_s: 8, position_mm: [0, 0, 9] },
    { t_s: 9, position_mm: [0, 0, 0] },
    { t_s: 10, position_mm: [0, 0, -20] },
  ],
};

/** The server finds what lies there when it starts. */
async function reamDeeply(): Promise<void> {
  const { server } = here;
  await server.kill();
  const file = join(server.dataFolder, 'deep.json');
  writeFileSync(file, JSON.stringify(script));
  const out = join(server.dataFolder, 'sessions', session);
  server.command('simulate', '--case', 'demo', '--script', file, '--tool', 'sphere 14', '--out', out);
  await server.start();
}

async function choose(page: Page, quality: 'plain' | 'full' | 'fine'): Promise<void> {
  await page.getByTestId('sections').click();
  await page.getByTestId('tool-drawing').selectOption(quality);
  await page.getByTestId('sections').click();
  await settled(page);
  await drawn(page);
}

test('spongy bone that was cut shows its pores but in the plainest picture, and all look as they did', async ({
  page,
}, info) => {
  await reamDeeply();
  await page.goto(here.server.url);
  await page.getByTestId('sessions').locator('summary').click();
  await page.getByTestId(`replay-${session}`).click();
  await page.waitForFunction((of) => window.__ream.replayOf === of && window.__ream.positionTicks !== null, session);
  await page.getByTestId('seek').fill('9.9');
  await page.waitForFunction(() => window.__ream.positionTicks === 9900);
  await page.getByTestId('show-reamer').uncheck();
  await page.getByTestId('view-axis').click();
  const box = await page.getByTestId('bone-canvas').boundingBox();
  if (box === null) throw new Error('no picture');
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  for (let i = 0; i < 6; ++i) await page.mouse.wheel(0, -300);

  /** Of the pocket's floor beside the pilot hole. */
  const spread = async (quality: 'plain' | 'full' | 'fine') => {
    await choose(page, quality);
    await page.screenshot({ path: info.outputPath(`${quality}.png`) });
    const floor = await page.screenshot({ clip: { x: x - 150, y: y - 140, width: 80, height: 80 } });
    return luminanceSpread(page, floor.toString('base64'));
  };
  const plain = await spread('plain');
  for (const quality of ['full', 'fine'] as const) expect(await spread(quality), quality).toBeGreaterThan(2 * plain);
  expect(await spread('plain')).toBeCloseTo(plain, 3);

  // The pocket with its rim: of the whole page the cut bone is too small a part to be missed.
  const clip = { x: x - 160, y: y - 200, width: 320, height: 400 };
  for (const quality of ['plain', 'full', 'fine'] as const) {
    await choose(page, quality);
    for (const colorScheme of ['light', 'dark'] as const) {
      await page.emulateMedia({ colorScheme });
      await settled(page);
      await drawn(page);
      await expectKeptLook(page, `cut-bone-${quality}-${colorScheme}`, await page.screenshot({ clip }));
    }
  }
});

test('on paper it is the same bone', async ({ page }) => {
  await reamDeeply();
  const { server } = here;
  const run = join(server.dataFolder, 'sessions', session);
  const picture = join(server.dataFolder, 'bone.png');
  server.command('render', run, '--out', picture);
  await expectKeptLook(page, 'cut-bone-paper', readFileSync(picture));

  const report = join(server.dataFolder, 'report.pdf');
  server.command('export', run, '--out', report);
  for (const number of [1, 2]) {
    const sheet = join(server.dataFolder, `sheet-${number}`);
    const of = ['-png', '-r', '90', '-singlefile', '-f', String(number), '-l', String(number), report, sheet];
    expect(spawnSync('pdftoppm', of).status).toBe(0);
    await expectKeptLook(page, `cut-bone-report-${number}`, readFileSync(`${sheet}.png`));
  }
});
