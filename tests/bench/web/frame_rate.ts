import type { Browser, Page } from '@playwright/test';

import type { Eye } from '../../../web/src/scene/shared_eye';
import type { BareServer } from './bare_server';
import { patienceMs, viewport } from './browser';
import { median, log } from './figures';
import { LiveVisit } from './live_visit';
import { ProcessorTime } from './processor_time';
import type { Turned } from './turned';

const turns = 5;
const turnS = 3;
/** Until the browser has compiled what is run often, and the bone has come to rest. */
const warmS = 3;
/** As the page's keys turn. */
const stepRad = 0.09;

/** How one page draws, medians of turns. */
export interface FrameRate {
  picturesPerS: number;
  /** Of a processor, per picture: in the page's own process, and drawing for it. */
  pageMs: number;
  drawingMs: number;
  triangles: number;
}

interface View {
  eye: Eye;
  widthPx: number;
  heightPx: number;
  /** Edges are. */
  smooth: boolean;
}

/** As the page draws by itself, and at its two higher levels. */
const drawings = { ours: 'automatic', full: 'full', fine: 'fine' } as const;
type Drawing = keyof typeof drawings;

/** Both pages draw the same bone and reamer from the same place, with the same edges, in turns, while its session goes on. */
export async function frameRates(
  browser: Browser,
  liveUrl: string,
  bare: BareServer,
): Promise<Record<Drawing | 'bare', FrameRate>> {
  const clock = await ProcessorTime.of(browser);
  const rates: Record<Drawing, FrameRate[]> = { ours: [], full: [], fine: [] };
  const others: FrameRate[] = [];
  for (let turn = 0; turn < turns; ++turn) {
    const visit = await LiveVisit.begin(browser, liveUrl);
    await visit.seeAll();
    const view = await viewOf(visit.page);
    for (const drawing of Object.keys(drawings) as Drawing[]) {
      await visit.draw(drawings[drawing]);
      const triangles = await visit.page.evaluate(() => window.__ream.triangles);
      const rate = await timed(clock, triangles, (seconds) => visit.turn(seconds));
      rates[drawing].push(rate);
      log(`${drawing}: pictures a second: ${rounded(rate)}`);
    }
    await visit.end();
    others.push(await turnBare(browser, clock, `${bare.url}${view.smooth ? '#smooth' : ''}`, view));
    log(`the bare page: pictures a second: ${rounded(others.at(-1))}`);
  }
  return { ours: medians(rates.ours), full: medians(rates.full), fine: medians(rates.fine), bare: medians(others) };
}

async function viewOf(page: Page): Promise<View> {
  const eye = await page.evaluate(() => window.__ream.eye);
  const box = await page.getByTestId('bone-canvas').boundingBox();
  const smooth = await page.evaluate(() => {
    const canvas = document.querySelector<HTMLCanvasElement>('[data-testid=bone-canvas]');
    return canvas?.getContext('webgl2')?.getContextAttributes()?.antialias === true;
  });
  if (box === null) throw new Error('the page shows no picture');
  return { eye, widthPx: box.width, heightPx: box.height, smooth };
}

async function turnBare(browser: Browser, clock: ProcessorTime, url: string, view: View): Promise<FrameRate> {
  const page = await browser.newPage({ viewport });
  page.setDefaultTimeout(patienceMs);
  await page.goto(url);
  await page.waitForFunction(() => window.bare !== undefined);
  const triangles = await page.evaluate(({ eye: { target, towardsEye, distanceMm }, widthPx, heightPx }) => {
    window.bare?.see({
      widthPx,
      heightPx,
      targetMm: [target.x, target.y, target.z],
      eyeMm: [
        target.x + towardsEye.x * distanceMm,
        target.y + towardsEye.y * distanceMm,
        target.z + towardsEye.z * distanceMm,
      ],
    });
    return window.bare?.triangles() ?? 0;
  }, view);
  const rate = await timed(clock, triangles, (seconds) =>
    page.evaluate(async ([step, s]) => await window.bare?.turn(step, s), [stepRad, seconds] as const),
  );
  await page.context().close();
  return rate;
}

async function timed(
  clock: ProcessorTime,
  triangles: number,
  turn: (seconds: number) => Promise<Turned | undefined>,
): Promise<FrameRate> {
  await turn(warmS);
  const before = await clock.read();
  const turned = await turn(turnS);
  const after = await clock.read();
  if (turned === undefined) throw new Error('the bare page shows no picture');
  const { pictures, seconds } = turned;
  return {
    picturesPerS: pictures / seconds,
    pageMs: (1000 * (after.pagesS - before.pagesS)) / pictures,
    drawingMs: (1000 * (after.drawingS - before.drawingS)) / pictures,
    triangles,
  };
}

function medians(rates: FrameRate[]): FrameRate {
  const of = (value: (rate: FrameRate) => number) => median(rates.map(value));
  return {
    picturesPerS: of((rate) => rate.picturesPerS),
    pageMs: of((rate) => rate.pageMs),
    drawingMs: of((rate) => rate.drawingMs),
    triangles: of((rate) => rate.triangles),
  };
}

const rounded = (rate: FrameRate | undefined) =>
  `${rate?.picturesPerS.toFixed(1) ?? ''} (${rate?.drawingMs.toFixed(0) ?? ''} ms of a processor each)`;
