// Every page in light and dark: axe finds nothing, nothing is cut off, and what is touched is large enough.
import { writeFileSync } from 'node:fs';

import { AxeBuilder } from '@axe-core/playwright';
import { expect, type Page, test } from '@playwright/test';

import { fullTests } from './full_tests';
import { differsAtMost, difference, expectKeptLook } from './kept_pictures';
import { goThroughEveryPage, olga, tom } from './every_page';
import { misplaced } from './misplaced';
import { serverForEachTest } from './server_for_each_test';
import { settled, stillPicture } from './settled';

test.use({ actionTimeout: 30_000 });
const here = serverForEachTest([olga, tom]);

/** What axe finds, in words. */
async function faults(page: Page, only: 'everything' | 'colours'): Promise<string[]> {
  const axe = new AxeBuilder({ page });
  if (only === 'colours') axe.withRules(['color-contrast', 'link-in-text-block']);
  const { violations } = await axe.analyze();
  return violations.flatMap(({ id, nodes }) =>
    nodes.map(({ target, failureSummary }) => `${id}: ${target.join(' ')}: ${failureSummary ?? ''}`),
  );
}

/** Dark pages are the light ones in other colours: what else there is to them, and their pictures, is for full tests. */
test('axe finds nothing on any page, in light and dark, and all look as they did', async ({ page }, info) => {
  test.setTimeout(600_000);
  const seen: string[] = [];
  await goThroughEveryPage(page, here.server.url, async (name) => {
    for (const colorScheme of ['light', 'dark'] as const) {
      const whole = fullTests || colorScheme === 'light';
      await page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
      await expect(page.locator('html')).toHaveAttribute('data-theme', colorScheme);
      if (whole) {
        const png = await stillPicture(page);
        writeFileSync(info.outputPath(`${name}-${colorScheme}.png`), png);
        seen.push(await expectKeptLook(page, `${name}-${colorScheme}`, png));
      } else await settled(page);
      expect.soft(await faults(page, whole ? 'everything' : 'colours'), `${name} ${colorScheme}`).toEqual([]);
    }
  });
  // The measure tells pages from each other, in full tests light from dark. Two that are alike in light may follow each other.
  const told = fullTests ? seen : [seen[0], seen.at(-1)];
  for (let i = 1; i < told.length; ++i)
    expect(await difference(page, told[i - 1] ?? '', told[i] ?? ''), `picture ${i}`).toBeGreaterThan(differsAtMost);
});

const tablets = [
  [1280, 720],
  [1024, 768],
  [820, 1180],
] as const;

test.describe('on a tablet', () => {
  test.use({ hasTouch: true });
  test('nothing is cut off or covered, and what is touched is large enough', async ({ page }, info) => {
    test.setTimeout(420_000);
    await goThroughEveryPage(page, here.server.url, async (name) => {
      for (const [width, height] of fullTests ? tablets : tablets.slice(1)) {
        await page.setViewportSize({ width, height });
        await settled(page);
        await page.screenshot({ path: info.outputPath(`${name}-${width}.png`) });
        expect.soft(await misplaced(page), `${name} ${width}x${height}`).toEqual([]);
      }
      await page.setViewportSize({ width: 1280, height: 720 });
    });
  });
});
