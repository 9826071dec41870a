// The same moment of one operation on the live page, in theatre and in its review, by the quality of the picture.
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { expect, type Page, test } from '@playwright/test';

import { pictureLevels } from '../../web/src/state/view_settings';
import { fullTests } from './full_tests';
import { difference, expectKeptLook } from './kept_pictures';
import { pictureOfBone } from './pixels';
import { post, ticksPass, untilReady } from './rest_as_page';
import { serverForEachTest, untilLive } from './server_for_each_test';
import { settled } from './settled';

const here = serverForEachTest();
const deepestS = 6;
const restsFromS = 8;
/** Reams through the plate into spongy bone, withdraws and holds still; exams by hand start elsewhere each time. */
const script = {
  device: 'poses',
  duration_s: 3600,
  poses: [
    { t_s: 0, position_mm: [0, 0, -20] },
    { t_s: 2, position_mm: [0, 0, -1] },
    { t_s: deepestS, position_mm: [0, 0, 5] },
    { t_s: restsFromS, position_mm: [0, 0, -30] },
  ],
  buttons: [{ t_s: restsFromS, spindle: false }],
};

/** A session in theatre whose reamer has come to rest; its id. */
async function reamAndRest(page: Page): Promise<string> {
  const scripts = join(here.server.dataFolder, 'scripts');
  mkdirSync(scripts, { recursive: true });
  writeFileSync(join(scripts, 'rests.json'), JSON.stringify(script));
  // The live page would start a demo.
  await page.goto(`${here.server.url}/#/sessions`);
  await untilReady(page, here.server.url);
  const { id } = await post(page, 'sessions', { case: 'demo', script: 'rests', device: 'script', theatre: true });
  await post(page, `sessions/${id}/start`);
  await ticksPass(page, id, restsFromS * 1000 + 500);
  return id;
}

/** The page, loaded anew by who has chosen that quality. */
async function open(page: Page, hash: string, toolDrawing: string): Promise<void> {
  await page.evaluate((chosen) => {
    for (const key of ['ream.view.anyone', 'ream.view.anyone.review'])
      window.localStorage.setItem(key, JSON.stringify({ toolDrawing: chosen }));
  }, toolDrawing);
  await page.goto(`${here.server.url}/${hash}`);
  await page.reload();
}

/** From run to run 0.002 of a picture differ, from one quality to the next 0.03 at least. */
const differsAtMost = 0.01;

async function expectKeptBone(page: Page, name: string): Promise<string> {
  await settled(page);
  const canvas = page.getByTestId('bone-canvas').first();
  const png = Buffer.from(await pictureOfBone(canvas), 'base64');
  writeFileSync(test.info().outputPath(`${name}.png`), png);
  return expectKeptLook(page, name, png, differsAtMost);
}

/** A quality that nobody sees would be none. */
async function expectAllDiffer(page: Page, pictures: string[]): Promise<void> {
  for (let i = 1; i < pictures.length; ++i)
    expect(await difference(page, pictures[i - 1] ?? '', pictures[i] ?? ''), `picture ${i}`).toBeGreaterThan(
      differsAtMost,
    );
}

test('live, in theatre and in the review a session looks as it did, by the quality of the picture', async ({
  page,
}) => {
  test.setTimeout(600_000);
  await page.emulateMedia({ reducedMotion: 'reduce' });
  const id = await reamAndRest(page);
  const seen = { theatre: [] as string[], live: [] as string[], review: [] as string[] };
  const inLightAndDark = async (where: 'live' | 'review', level: string) => {
    for (const colorScheme of fullTests ? (['dark', 'light'] as const) : (['light'] as const)) {
      await page.emulateMedia({ colorScheme });
      const picture = await expectKeptBone(page, `bone-${where}-${level}-${colorScheme}`);
      if (colorScheme === 'light') seen[where].push(picture);
    }
  };
  // In full tests every quality everywhere, in light and dark; else every quality live, and one elsewhere.
  const elsewhere = fullTests ? pictureLevels : pictureLevels.slice(-1);
  for (const level of elsewhere) {
    await open(page, '#/trainee', level);
    await expect(page.getByTestId('trainee-page')).toHaveAttribute('data-theatre', 'true');
    await untilLive(page);
    // Around the wound all is covered, so dark is as light.
    seen.theatre.push(await expectKeptBone(page, `bone-theatre-${level}`));
  }
  for (const level of pictureLevels) {
    await open(page, '#', level);
    await untilLive(page);
    await inLightAndDark('live', level);
  }
  await post(page, `sessions/${id}/stop`);
  for (const level of elsewhere) {
    await open(page, `#/review/${id}`, level);
    await expect(page.getByTestId('pane-0')).toHaveAttribute('data-position', '0', { timeout: 60_000 });
    await page.getByTestId('seek').fill(String(deepestS));
    await expect(page.getByTestId('pane-0')).toHaveAttribute('data-position', String(deepestS * 1000));
    await expect(page.getByTestId('review-picture')).toHaveAttribute('data-stale', 'false', { timeout: 90_000 });
    await inLightAndDark('review', level);
  }
  for (const pictures of Object.values(seen)) await expectAllDiffer(page, pictures);
});
