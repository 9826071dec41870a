// Tests judge a page by its state: when it has everything that it asked for, and has drawn it.
import { expect, type Page, type Request } from '@playwright/test';

import { difference, small } from './kept_pictures';

const settlesWithinMs = 60_000;
/** Between two pictures of a page that rests so many of their points may differ: a digit of its loop's timing may. */
const stillAtMost = 0.0005;

const requests = new WeakMap<Page, Set<Request>>();

/** To be called before the page is opened: what it asks the server for is waited for. */
export function followRequests(page: Page): void {
  const underWay = new Set<Request>();
  requests.set(page, underWay);
  page.on('request', (request) => {
    if (request.url().startsWith('http')) underWay.add(request);
  });
  page.on('requestfinished', (request) => underWay.delete(request));
  page.on('requestfailed', (request) => underWay.delete(request));
}

/** Why the page is not yet what it is going to be; nothing: it is. */
async function unsettled(page: Page): Promise<string[]> {
  const reasons = await page.evaluate(async () => {
    const nextFrame = () => new Promise<void>((done) => requestAnimationFrame(() => setTimeout(done)));
    const isSeen = (element: Element) => element.checkVisibility({ visibilityProperty: true });
    const reasons = new Set<string>();
    for (let frame = 0; frame < 2; ++frame) {
      // What is drawn may ask for another drawing.
      await window.__ream.allDrawn();
      await nextFrame();
      if (window.__ream.simplerDue) reasons.add('its bone is of fewer triangles');
      if (document.fonts.status !== 'loaded') reasons.add('its fonts are loaded');
      for (const animation of document.getAnimations())
        if (animation.playState === 'running') reasons.add('something moves');
      for (const image of document.images) if (isSeen(image) && !image.complete) reasons.add(`${image.alt} is loaded`);
      for (const busy of document.querySelectorAll('[aria-busy="true"], [data-pending="true"]'))
        reasons.add(`${busy.getAttribute('data-testid') ?? busy.className} is busy`);
      for (const element of document.querySelectorAll('p, [role="status"]')) {
        const text = (element.textContent ?? '').trim();
        if (text.endsWith('…') && isSeen(element)) reasons.add(text);
      }
    }
    return [...reasons];
  });
  for (const request of requests.get(page) ?? []) reasons.push(`${request.method()} ${request.url()}`);
  return reasons;
}

/** Until nothing on the page is on its way: no answer, no font or image, nothing that is to be drawn. */
export async function settled(page: Page): Promise<void> {
  await expect
    .poll(() => unsettled(page), { message: 'the page settles', timeout: settlesWithinMs, intervals: [0, 20, 50, 100] })
    .toEqual([]);
}

/** A picture of the page as it stays: settled, and the same twice. */
export async function stillPicture(page: Page): Promise<Buffer> {
  await settled(page);
  // A plot goes on with its session's clock, which does not stop while the session is paused.
  const look = async () => {
    const png = await page.screenshot({ mask: [page.locator('.plot')] });
    return small(page, png.toString('base64'));
  };
  let now = await look();
  const moved = async () => {
    const before = now;
    now = await look();
    return difference(page, before, now);
  };
  await expect
    .poll(moved, { message: 'the page rests', timeout: settlesWithinMs, intervals: [0] })
    .toBeLessThanOrEqual(stillAtMost);
  return page.screenshot();
}
