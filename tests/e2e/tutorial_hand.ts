// Does what the tutorial's sentences say, by the names of keys, buttons and gestures that stand in them.
import { expect, type Page } from '@playwright/test';

/** What keys are called on the page and in Playwright. */
const keyNames: Readonly<Record<string, string>> = {
  Ctrl: 'Control',
  Shift: 'Shift',
  '←': 'ArrowLeft',
  'Page up': 'PageUp',
  Space: ' ',
  S: 's',
  I: 'i',
  B: 'b',
  '+': '+',
  Home: 'Home',
  Tab: 'Tab',
  Enter: 'Enter',
};

export const tutorial = (page: Page) => page.getByTestId('tutorial');

export async function untilStep(page: Page, name: string): Promise<void> {
  await expect(tutorial(page)).toHaveAttribute('data-step', name, { timeout: 90_000 });
}

const stepNow = (page: Page) => tutorial(page).getAttribute('data-step');
const figure = async (page: Page, id: string) => Number(await page.getByTestId(id).textContent());

/** The names in the sentence that is shown. */
export async function named(page: Page): Promise<string[]> {
  return page.getByTestId('tutorial-do').locator('kbd').allTextContents();
}

/** The keys in the sentence that is shown. */
export async function namedKeys(page: Page): Promise<string[]> {
  return (await named(page)).map((name) => {
    const key = keyNames[name];
    if (key === undefined) throw new Error(`the tutorial names no key: ${name}`);
    return key;
  });
}

/** The planned depth, as the sentence says it. */
async function namedDepth(page: Page): Promise<number> {
  const sentence = (await page.getByTestId('tutorial-do').textContent()) ?? '';
  return Number(/at (\d+\.\d+) mm/.exec(sentence)?.[1]);
}

/** On a busy machine the page shows bone as gone some moments after it is. What was reamed meanwhile is within the plan's band. */
const shownLateMm = 0.15;

/** While something is held down, until the reading says that the plan is all but reached. */
export async function untilNamedDepth(page: Page): Promise<void> {
  const planned = await namedDepth(page);
  expect(planned).toBeGreaterThan(0);
  await expect
    .poll(() => figure(page, 'depth'), { timeout: 120_000, intervals: [30] })
    .toBeGreaterThanOrEqual(planned - shownLateMm);
}

/** Does something again and again until the step is another; the page is given time to show what it did. */
export async function againUntilLeft(page: Page, step: string, action: () => Promise<void>): Promise<void> {
  while ((await stepNow(page)) === step) {
    const before = await page.evaluate(() => window.__ream.lastTick ?? 0);
    await action();
    await page.waitForFunction((tick) => (window.__ream.lastTick ?? 0) > tick + 60, before);
  }
}

/** Presses harder while the gauge does not show the wanted thrust. */
export async function harder(page: Page, press: () => Promise<void>): Promise<void> {
  const inBand = await page.locator('.tutorial-gauge.inside').isVisible();
  if (!inBand && Number(await page.getByTestId('push-level').inputValue()) < 52) await press();
}

/** From the first step to the last but one, by the keys that its sentences name. */
export async function reamByKeys(page: Page): Promise<void> {
  const [hold = '', turn = '', zoom = ''] = await namedKeys(page);
  for (let i = 0; i < 5; ++i) await page.keyboard.press(`${hold}+${turn}`);
  await page.keyboard.press(zoom);
  await untilStep(page, 'aim');
  for (const key of await namedKeys(page)) await page.keyboard.press(key);
  await untilStep(page, 'spindle');
  for (const key of await namedKeys(page)) await page.keyboard.press(key);
  await untilStep(page, 'touch');

  const [push = ''] = await namedKeys(page);
  await page.keyboard.down(push);
  await untilStep(page, 'press');
  const [kept, more = ''] = await namedKeys(page);
  expect(kept).toBe(push);
  await againUntilLeft(page, 'press', () => harder(page, () => page.keyboard.press(more)));
  await untilStep(page, 'stop');
  expect(await namedKeys(page)).toEqual([push]);
  await untilNamedDepth(page);
  await page.keyboard.up(push);
  await untilStep(page, 'withdraw');

  const [back = ''] = await namedKeys(page);
  await page.keyboard.down(back);
  await untilStep(page, 'result');
  await page.keyboard.up(back);
}

/** The middle of the picture, where the plan is whatever the view. */
export async function middle(page: Page): Promise<{ x: number; y: number }> {
  const box = await page.getByTestId('bone-canvas').boundingBox();
  if (box === null) throw new Error('no picture');
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

/** What the panel of the tutorial lies over and should not. */
export function covered(page: Page): Promise<string[]> {
  return page.evaluate(() => {
    const panel = document.querySelector('.tutorial')?.getBoundingClientRect();
    const canvas = document.querySelector('canvas')?.getBoundingClientRect();
    if (panel === undefined || canvas === undefined) return ['no panel or no picture'];
    const meets = (box: { left: number; right: number; top: number; bottom: number }) =>
      box.left < panel.right - 1 &&
      box.right > panel.left + 1 &&
      box.top < panel.bottom - 1 &&
      box.bottom > panel.top + 1;
    const found: string[] = [];
    // The plan and what is aimed at lie within this of the middle.
    const [x, y] = [(canvas.left + canvas.right) / 2, (canvas.top + canvas.bottom) / 2];
    const reach = 0.15 * Math.min(canvas.width, canvas.height);
    if (meets({ left: x - reach, right: x + reach, top: y - reach, bottom: y + reach })) found.push('the plan');
    const others = '.alarm, .live-strip > *, .views > *, .notice, .practice, .side, .header';
    for (const other of document.querySelectorAll(others))
      if (other.checkVisibility() && meets(other.getBoundingClientRect())) found.push(other.className || other.tagName);
    const { scrollWidth } = document.documentElement;
    if (scrollWidth > window.innerWidth) found.push(`the page is ${scrollWidth} px wide`);
    const own = document.querySelector('.tutorial');
    if (own !== null && own.scrollHeight > own.clientHeight + 1) found.push('its own end');
    return found;
  });
}
