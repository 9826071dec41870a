// What the tests of the page share: a server of their own, and pages in which nothing may go wrong unseen.
import { expect, type Page, test } from '@playwright/test';

import type { DebugReadout } from '../../web/src/debug_readout';
import { followRequests } from './settled';
import { passwordOf, ServerProcess, type TestUser } from './server_process';

class Surroundings {
  /** Of the test that runs. */
  server!: ServerProcess;
  problems: string[] = [];

  /** An error in this page fails the test; the test's first page is watched already. */
  watchForErrors(page: Page): void {
    followRequests(page);
    page.on('pageerror', (error) => this.problems.push(error.message));
  }
}

/** To be called once in a file of tests. Without users everybody may do everything. */
export function serverForEachTest(users: readonly TestUser[] = []): Surroundings {
  const here = new Surroundings();
  test.beforeEach(async ({ page }) => {
    here.problems = [];
    here.watchForErrors(page);
    here.server = new ServerProcess();
    for (const user of users) here.server.addUser(user);
    await here.server.start();
  });
  test.afterEach(async () => {
    await here.server.dispose();
    expect(here.problems).toEqual([]);
  });
  return here;
}

/** Fills in the form that the page shows to who is not known. */
export async function logIn(page: Page, name: string, password = passwordOf(name)): Promise<void> {
  await page.getByTestId('login-name').fill(name);
  await page.getByTestId('login-password').fill(password);
  await page.getByTestId('log-in').click();
}

export const readout = (page: Page): Promise<DebugReadout> => page.evaluate(() => window.__ream);
export const untilLive = (page: Page) => page.waitForFunction(() => window.__ream.live, null, { timeout: 60_000 });
/** Waits until what was last changed has been drawn. */
export const drawn = (page: Page) =>
  page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
