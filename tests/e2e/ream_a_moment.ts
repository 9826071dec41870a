// Somebody at the page takes the reamer by keys and cuts a little bone, or as much as a story needs.
import { expect, type Page } from '@playwright/test';

import { logIn, readout } from './server_for_each_test';

/** From the moment that the page has the reamer until so much bone is gone; nothing is pressed any more. */
export async function reamByKeysUntil(page: Page, removedMm3: number): Promise<void> {
  await page.waitForFunction(() => window.__ream.deviceLink === 'holding', null, { timeout: 60_000 });
  await page.getByTestId('bone-canvas').focus();
  await page.keyboard.press('s');
  await page.keyboard.down(' ');
  const removed = async () => parseFloat((await page.getByTestId('removed-volume').textContent()) ?? '');
  await expect.poll(removed, { timeout: 120_000, intervals: [50] }).toBeGreaterThan(removedMm3);
  await page.keyboard.up(' ');
}

/** A trainee's session, from the login to the first bone that is cut; its id. */
export async function practise(page: Page, name: string, password: string): Promise<string> {
  await logIn(page, name, password);
  const start = page.getByRole('button', { name: 'Practise', exact: true });
  // The server prepares its demo first.
  await expect(start).toBeEnabled({ timeout: 120_000 });
  await start.click();
  await reamByKeysUntil(page, 10);
  return (await readout(page)).sessionId ?? '';
}
