import type { Browser } from '@playwright/test';

import { ServerProcess } from '../../e2e/server_process';
import { BareServer } from './bare_server';
import { launchBrowser } from './browser';
import { log } from './figures';
import { frameRates } from './frame_rate';
import { handDelay } from './hand_delay';
import { heapOverTime } from './heap';
import { lateJoin } from './late_join';
import { scriptTime } from './script_time';
import { Sessions } from './sessions';

/** Cases of the data folder, by the triangles of their surface. */
const cases = { '67k': 'demo', '490k': 'fine' } as const;
/** REAM_BENCH_WEB_MINUTES: how long the heap is watched. */
const heapMinutes = Number(process.env.REAM_BENCH_WEB_MINUTES ?? 4);
/** REAM_BENCH_WEB_ONLY: parts, with commas between; all where it is not set. */
const wanted = process.env.REAM_BENCH_WEB_ONLY?.split(',') ?? ['hand', 'script', 'join', 'frames', 'heap'];

/** REAM_BENCH_WEB_SIZES: of the two cases. */
const sizes = process.env.REAM_BENCH_WEB_SIZES?.split(',') ?? Object.keys(cases);

/** Everything on one server that runs on the data folder, one session and one page at a time. */
export async function measurePage(dataFolder: string): Promise<Record<string, object>> {
  const server = new ServerProcess(dataFolder);
  const bare = new BareServer();
  const browser = await launchBrowser();
  try {
    await server.start();
    await bare.start();
    return await measured(browser, server.url, bare);
  } finally {
    await browser.close();
    bare.dispose();
    await server.dispose();
  }
}

async function measured(browser: Browser, url: string, bare: BareServer): Promise<Record<string, object>> {
  const sessions = new Sessions(url);
  await sessions.ready();
  const figures: Record<string, object> = {};
  const measure = async (part: string, name: string, run: () => Promise<object>) => {
    if (!wanted.includes(part)) return;
    log(name);
    figures[name] = await run();
  };
  const during = async (caseName: string, script: string, watch: (id: string) => Promise<void>) => {
    const id = await sessions.begin(caseName, script);
    await watch(id);
    await sessions.end(id);
  };
  await measure('hand', 'hand', () => handDelay(browser, url));
  await during(cases['67k'], 'usual', () => measure('script', 'script', () => scriptTime(browser, url)));
  for (const [size, caseName] of Object.entries(cases).filter(([size]) => sizes.includes(size)))
    await during(caseName, 'long', async (id) => {
      await measure('join', `join ${size}`, () => lateJoin(browser, url));
      await measure('frames', `frames ${size}`, async () => {
        await bare.show(sessions.streamUrl(id));
        return frameRates(browser, url, bare);
      });
      if (size === '67k') await measure('heap', 'heap', () => heapOverTime(browser, url, heapMinutes));
    });
  return figures;
}
