import { type Browser, chromium } from '@playwright/test';

import config from '../../../web/playwright.config';

/** The browser as the tests have it, with the same size of window. */
export const viewport = config.use?.viewport ?? { width: 1280, height: 720 };

/** What ends the browser's habit of drawing no more than 60 pictures a second. */
export const asFastAsItCan = ['--disable-frame-rate-limit', '--disable-gpu-vsync'];

export function launchBrowser(moreArguments: readonly string[] = []): Promise<Browser> {
  const options = config.use?.launchOptions;
  return chromium.launch({ ...options, args: [...(options?.args ?? []), ...moreArguments] });
}
