import type { Browser, CDPSession } from '@playwright/test';

/** What the browser's processes have computed, which tells the page's cost apart from what else the machine does. */
export class ProcessorTime {
  private constructor(private readonly devTools: CDPSession) {}

  static async of(browser: Browser): Promise<ProcessorTime> {
    return new ProcessorTime(await browser.newBrowserCDPSession());
  }

  /** Of the pages, and of the process that draws for them, seconds since they began. */
  async read(): Promise<{ pagesS: number; drawingS: number }> {
    const { processInfo } = await this.devTools.send('SystemInfo.getProcessInfo');
    const sum = (type: string) =>
      processInfo.filter((process) => process.type === type).reduce((total, { cpuTime }) => total + cpuTime, 0);
    return { pagesS: sum('renderer'), drawingS: sum('GPU') };
  }
}
