// Every page in light and dark: axe finds nothing, nothing is cut off, and what is touched is large enough.
import { writeFileSync } from 'node:fs';

import { AxeBuilder } from '@axe-core/playwright';
import { expect, type Page, test } from '@playwright/test';

import { differsAtMost, difference, expectKeptLook } from './kept_pictures';
import { goThroughEveryPage, olga, tom } from './every_page';
import { serverForEachTest } from './server_for_each_test';
import { settled, stillPicture } from './settled';

test.use({ actionTimeout: 30_000 });
const here = serverForEachTest([olga, tom]);

/** What axe finds, in words. */
async function faults(page: Page): Promise<string[]> {
  const { violations } = await new AxeBuilder({ page }).analyze();
  return violations.flatMap(({ id, nodes }) =>
    nodes.map(({ target, failureSummary }) => `${id}: ${target.join(' ')}: ${failureSummary ?? ''}`),
  );
}

test('axe finds nothing on any page, in light and dark, and all look as they did', async ({ page }, info) => {
  test.setTimeout(600_000);
  const seen: string[] = [];
  await goThroughEveryPage(page, here.server.url, async (name) => {
    for (const colorScheme of ['light', 'dark'] as const) {
      await page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
      await expect(page.locator('html')).toHaveAttribute('data-theme', colorScheme);
      const png = await stillPicture(page);
      writeFileSync(info.outputPath(`${name}-${colorScheme}.png`), png);
      seen.push(await expectKeptLook(page, `${name}-${colorScheme}`, png));
      expect.soft(await faults(page), `${name} ${colorScheme}`).toEqual([]);
    }
  });
  // The measure tells pages from each other, and light from dark.
  for (let i = 1; i < seen.length; ++i)
    expect(await difference(page, seen[i - 1] ?? '', seen[i] ?? ''), `picture ${i}`).toBeGreaterThan(differsAtMost);
});

/** What sticks out of the window, is hidden behind something else, or is too small for a finger. */
function misplaced(page: Page): Promise<string[]> {
  return page.evaluate(() => {
    const least = 40;
    const found: string[] = [];
    const { scrollWidth } = document.scrollingElement ?? document.documentElement;
    if (scrollWidth > window.innerWidth) found.push(`the page is ${scrollWidth} px wide`);
    const name = (element: Element) =>
      `${element.tagName.toLowerCase()} ${element.getAttribute('data-testid') ?? element.className} “${(element.textContent ?? '').trim().slice(0, 24)}”`;
    const seen = 'button, select, summary, textarea, input, nav a, .current-user a, a.strip-button, a.plain-button';
    for (const element of document.querySelectorAll<HTMLElement>(seen)) {
      if (!element.checkVisibility({ visibilityProperty: true, opacityProperty: true })) continue;
      // A box is as large as what is pressed for it.
      const pressed = element.matches('[type="checkbox"], [type="radio"], [type="file"]')
        ? (element.closest('label') ?? element)
        : element;
      const scroller = element.closest('.table-scroll, .side, .steps, .content');
      const box = pressed.getBoundingClientRect();
      if (box.width === 0) continue;
      if (scroller === null && (box.left < -0.5 || box.right > window.innerWidth + 0.5))
        found.push(`${name(element)} sticks out`);
      if (!element.matches('.mark, .tile-open, [type="file"]') && (box.height < least - 0.5 || box.width < least - 0.5))
        found.push(`${name(element)} is ${Math.round(box.width)} x ${Math.round(box.height)}`);
      const [x, y] = [box.left + box.width / 2, box.top + box.height / 2];
      if (x < 0 || y < 0 || x > window.innerWidth || y > window.innerHeight) continue;
      const view = scroller?.getBoundingClientRect();
      if (view && (y < view.top || y > view.bottom || x < view.left || x > view.right)) continue;
      const top = document.elementFromPoint(x, y);
      // Marks of moments that are close lie over each other; all of them are in the list of events, too.
      if (
        top === null ||
        !(pressed.contains(top) || top.contains(pressed) || element.matches('.tile-open, [type="file"], .mark'))
      )
        found.push(`${name(element)} is behind ${top === null ? 'nothing' : name(top)}`);
    }
    return found;
  });
}

test.describe('on a tablet', () => {
  test.use({ hasTouch: true });
  test('nothing is cut off or covered, and what is touched is large enough', async ({ page }, info) => {
    test.setTimeout(420_000);
    await goThroughEveryPage(page, here.server.url, async (name) => {
      for (const [width, height] of [
        [1280, 720],
        [1024, 768],
        [820, 1180],
      ] as const) {
        await page.setViewportSize({ width, height });
        await settled(page);
        await page.screenshot({ path: info.outputPath(`${name}-${width}.png`) });
        expect.soft(await misplaced(page), `${name} ${width}x${height}`).toEqual([]);
      }
      await page.setViewportSize({ width: 1280, height: 720 });
    });
  });
});
