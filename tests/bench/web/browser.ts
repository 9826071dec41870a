import { type Browser, chromium } from '@playwright/test';

import config from '../../../web/playwright.config';

/** The browser as the tests have it, with the same size of window. */
export const viewport = config.use?.viewport ?? { width: 1280, height: 720 };

/** On a busy machine all takes long; the figures tell of that. */
export const patienceMs = 180_000;

export function launchBrowser(): Promise<Browser> {
  return chromium.launch(config.use?.launchOptions);
}
