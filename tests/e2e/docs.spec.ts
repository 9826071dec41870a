// The papers as the program serves them: from the page's help to a paper, from paper to paper, for every window.
import { AxeBuilder } from '@axe-core/playwright';
import { expect, type Page, test } from '@playwright/test';

import { serverForEachTest } from './server_for_each_test';

const here = serverForEachTest();

async function faults(page: Page): Promise<string[]> {
  const { violations } = await new AxeBuilder({ page }).analyze();
  return violations.flatMap(({ id, nodes }) => nodes.map(({ target }) => `${id}: ${target.join(' ')}`));
}

/** How far a page can be pushed sideways, which nobody should need. */
const overflow = (page: Page) =>
  page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);

test('Help leads to the list of guides, and that to each guide', async ({ page: session, context }) => {
  const violations: string[] = [];
  context.on('console', (message) => {
    if (message.type() === 'error' && message.page()?.url().includes('/docs')) violations.push(message.text());
  });
  await session.goto(`${here.server.url}/#/cases`);
  const opened = context.waitForEvent('page');
  await session.getByTestId('to-help').click();
  const page = await opened;
  await expect(page).toHaveURL(/\/docs\/$/);
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('Guides');

  await page.getByRole('main').getByRole('link', { name: 'For trainees' }).click();
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('For trainees');
  await page.getByRole('navigation', { name: 'On this page' }).getByRole('link', { name: 'Depth' }).click();
  await expect(page).toHaveURL(/trainee\.html#depth$/);
  await page.getByRole('navigation', { name: 'All guides' }).getByRole('link', { name: 'Troubleshooting' }).click();
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('Troubleshooting');

  const reply = await page.goto(`${here.server.url}/docs`);
  expect(reply?.status()).toBe(200);
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('Guides');
  expect(violations).toEqual([]);
});

test(
  'axe finds nothing on guides, in light and dark, and no window is too narrow',
  { tag: '@full' },
  async ({ page }, info) => {
    test.setTimeout(300_000);
    for (const guide of ['index', 'trainee', 'reference', 'api']) {
      await page.goto(`${here.server.url}/docs/${guide}.html`);
      for (const colorScheme of ['light', 'dark'] as const) {
        await page.emulateMedia({ colorScheme });
        expect.soft(await faults(page), `${guide} ${colorScheme}`).toEqual([]);
      }
      for (const width of [390, 768, 1280, 1920]) {
        await page.setViewportSize({ width, height: 900 });
        expect.soft(await overflow(page), `${guide} ${width}`).toBe(0);
      }
      await page.screenshot({ path: info.outputPath(`${guide}.png`) });
    }
  },
);
