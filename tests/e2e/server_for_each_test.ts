// What the tests of the page share: a server of their own, and pages in which nothing may go wrong unseen.
import { mkdtempSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { type Browser, type BrowserContext, expect, type Page, test } from '@playwright/test';

import type { DebugReadout } from '../../web/src/debug_readout';
import { followRequests } from './settled';
import { passwordOf, ServerProcess, type TestUser } from './server_process';

interface WindowSize {
  width: number;
  height: number;
}

/** The windows of a test. */
export class Windows {
  problems: string[] = [];
  private contexts: BrowserContext[] = [];

  /** An error in this page fails the test; the test's first page is watched already. */
  watchForErrors(page: Page): void {
    followRequests(page);
    page.on('pageerror', (error) => this.problems.push(error.message));
  }

  /** A window of somebody else, who logs in for themself; it is closed after the test. */
  async openWindow(browser: Browser, viewport: WindowSize, url: string): Promise<Page> {
    const context = await browser.newContext({ viewport });
    this.contexts.push(context);
    const page = await context.newPage();
    this.watchForErrors(page);
    await page.goto(url);
    return page;
  }

  /** What draws on would slow the next test down. */
  async closeWindows(): Promise<void> {
    for (const context of this.contexts.splice(0)) await context.close();
  }
}

class Surroundings extends Windows {
  /** Of the test that runs. */
  server!: ServerProcess;

  windowOf(browser: Browser, viewport: WindowSize): Promise<Page> {
    return this.openWindow(browser, viewport, this.server.url);
  }
}

/** Before each test `begin`, after it `end`; an error in a window fails the test. */
export function watchEachTest(here: Windows, begin: () => Promise<void>, end: () => Promise<void>): void {
  test.beforeEach(async ({ page }) => {
    here.problems = [];
    here.watchForErrors(page);
    await begin();
  });
  test.afterEach(async () => {
    await here.closeWindows();
    await end();
    expect(here.problems).toEqual([]);
  });
}

interface Beginning {
  /** Without even the demo, which the server then makes itself. */
  emptyFolder?: boolean;
}

/** To be called once in a file of tests. Without users everybody may do everything. */
export function serverForEachTest(users: readonly TestUser[] = [], { emptyFolder }: Beginning = {}): Surroundings {
  const here = new Surroundings();
  const begin = async () => {
    here.server = new ServerProcess(emptyFolder ? mkdtempSync(join(tmpdir(), 'ream-e2e-')) : undefined);
    for (const user of users) here.server.addUser(user);
    await here.server.start();
  };
  watchEachTest(here, begin, () => here.server.dispose());
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
export async function drawn(page: Page): Promise<void> {
  await page.waitForFunction(() => !window.__ream.simplerDue);
  await page.evaluate(async () => {
    await window.__ream.allDrawn();
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  });
}
