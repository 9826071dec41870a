import type { Browser, CDPSession } from '@playwright/test';

import { median, log } from './figures';
import { LiveVisit } from './live_visit';

/** What a page keeps fills up in this time: the plot's seconds, caches, compiled code. */
const warmS = 60;
const everyS = 15;

export interface Heap {
  /** From the first reading to the last. */
  minutes: number;
  /** At the end. */
  mb: number;
  /** By the line through all readings (Theil and Sen), in 30 minutes. */
  growthMb: number;
}

interface Usage {
  usedSize: number;
  embedderHeapUsedSize: number;
  backingStorageSize: number;
}

const mbOf = ({ usedSize, embedderHeapUsedSize, backingStorageSize }: Usage) =>
  (usedSize + embedderHeapUsedSize + backingStorageSize) * 1e-6;

/** What page and workers keep after garbage was collected, buffers included, while a session is watched live. */
export async function heapOverTime(browser: Browser, liveUrl: string, minutes: number): Promise<Heap> {
  const visit = await LiveVisit.begin(browser, liveUrl);
  const page = await visit.devTools();
  const workers = await Workers.of(page);
  await visit.page.waitForTimeout(warmS * 1000);
  const readings: { minute: number; mb: number }[] = [];
  const beganMs = Date.now();
  for (let minute = 0; minute <= minutes;) {
    await page.send('HeapProfiler.collectGarbage');
    await workers.call('HeapProfiler.collectGarbage');
    const usages = [
      await page.send('Runtime.getHeapUsage'),
      ...(await workers.call('Runtime.getHeapUsage')),
    ] as Usage[];
    minute = (Date.now() - beganMs) / 60_000;
    readings.push({ minute, mb: usages.reduce((sum, usage) => sum + mbOf(usage), 0) });
    if (readings.length % 8 === 1)
      log(`heap after ${minute.toFixed(1)} minutes: ${readings.at(-1)?.mb.toFixed(2) ?? ''} MB`);
    await visit.page.waitForTimeout(everyS * 1000);
    const { live, sessionState } = await visit.page.evaluate(() => window.__ream);
    if (!live || sessionState !== 'running')
      throw new Error(`the session that is watched is ${sessionState ?? 'gone'}`);
  }
  await visit.end();
  return { minutes: readings.at(-1)?.minute ?? 0, mb: readings.at(-1)?.mb ?? 0, growthMb: 30 * slope(readings) };
}

/** MB a minute; the median of the slopes between all pairs. */
function slope(readings: { minute: number; mb: number }[]): number {
  return median(
    readings.flatMap((a, i) => readings.slice(i + 1).map((b) => (b.mb - a.mb) / Math.max(b.minute - a.minute, 1e-6))),
  );
}

/** The page's workers, reached through the page. */
class Workers {
  private readonly sessionIds: string[] = [];
  private readonly waiting = new Map<number, (result: unknown) => void>();
  private requests = 0;

  private constructor(private readonly page: CDPSession) {}

  static async of(page: CDPSession): Promise<Workers> {
    const workers = new Workers(page);
    page.on('Target.attachedToTarget', ({ sessionId, targetInfo }) => {
      if (targetInfo.type === 'worker') workers.sessionIds.push(sessionId);
    });
    page.on('Target.receivedMessageFromTarget', ({ message }) => {
      const { id, result } = JSON.parse(message) as { id?: number; result?: unknown };
      if (id !== undefined) workers.waiting.get(id)?.(result);
    });
    await page.send('Target.setAutoAttach', { autoAttach: true, waitForDebuggerOnStart: false, flatten: false });
    return workers;
  }

  call(method: string): Promise<unknown[]> {
    return Promise.all(
      this.sessionIds.map(async (sessionId) => {
        const id = ++this.requests;
        const answered = new Promise<unknown>((answer) => this.waiting.set(id, answer));
        await this.page.send('Target.sendMessageToTarget', { sessionId, message: JSON.stringify({ id, method }) });
        return answered.finally(() => this.waiting.delete(id));
      }),
    );
  }
}
