// How a page lies in its window.
import type { Page } from '@playwright/test';

/**
 * What sticks out of the window, is hidden behind something else, or is smaller than `least`, 40 px for a finger; and cells
 * of tables that are broken up: a short text that stands on more than two lines.
 */
export function misplaced(page: Page, least = 40): Promise<string[]> {
  return page.evaluate((least) => {
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
    for (const cell of document.querySelectorAll<HTMLElement>('td, th')) {
      const text = cell.innerText.trim();
      if (text === '' || text.length > 30 || cell.querySelector('button, svg, a') !== null) continue;
      const range = document.createRange();
      range.selectNodeContents(cell);
      const lines = new Set([...range.getClientRects()].map(({ top }) => Math.round(top / 8))).size;
      if (lines > 2) found.push(`${name(cell)} stands on ${lines} lines`);
    }
    return found;
  }, least);
}
