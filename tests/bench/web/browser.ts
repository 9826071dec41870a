import { type Browser, chromium } from '@playwright/test';

import config from '../../../web/playwright.config';

/** The browser as the tests have it, with the same size of window. */
export const viewport = config.use?.viewport ?? { width: 1280, height: 720 };

export function launchBrowser(): Promise<Browser> {
  return chromium.launch(config.use?.launchOptions);
}
