import type { Browser } from '@playwright/test';

import { viewport } from './browser';
import type { BareServer } from './bare_server';
import { median, tell } from './figures';
import { LiveVisit } from './live_visit';
import type { Turned } from './turned';

const turns = 5;
const turnS = 3;
const warmS = 0.5;
/** As the page's keys turn. */
const stepRad = 0.09;

export interface FrameRates {
  /** Pictures a second, medians. */
  ours: number;
  bare: number;
  triangles: number;
  bareTriangles: number;
  /** Of ours, one each turn. */
  joinedAfterMs: number[];
  openedAfterMs: number[];
}

const rate = ({ pictures, seconds }: Turned) => pictures / seconds;

/** Both pages draw the same bone in turns, while its session goes on. */
export async function frameRates(browser: Browser, liveUrl: string, bare: BareServer): Promise<FrameRates> {
  const ours: number[] = [];
  const others: number[] = [];
  const figures = { triangles: 0, bareTriangles: 0, joinedAfterMs: [] as number[], openedAfterMs: [] as number[] };
  for (let turn = 0; turn < turns; ++turn) {
    const visit = await LiveVisit.begin(browser, liveUrl);
    figures.joinedAfterMs.push(visit.joinedAfterMs);
    figures.openedAfterMs.push(visit.openedAfterMs);
    await visit.seeAll();
    const { eye, triangles } = await visit.page.evaluate(() => window.__ream);
    const size = await visit.page.getByTestId('bone-canvas').boundingBox();
    figures.triangles = triangles;
    await visit.turn(warmS);
    ours.push(rate(await visit.turn(turnS)));
    await visit.end();

    const page = await browser.newPage({ viewport });
    await page.goto(bare.url);
    await page.waitForFunction(() => window.bare !== undefined);
    const { target, towardsEye, distanceMm } = eye;
    await page.evaluate((view) => window.bare?.see(view), {
      widthPx: size?.width ?? 0,
      heightPx: size?.height ?? 0,
      targetMm: [target.x, target.y, target.z] as [number, number, number],
      eyeMm: [
        target.x + towardsEye.x * distanceMm,
        target.y + towardsEye.y * distanceMm,
        target.z + towardsEye.z * distanceMm,
      ] as [number, number, number],
    });
    figures.bareTriangles = await page.evaluate(() => window.bare?.triangles() ?? 0);
    const turnBare = (seconds: number) =>
      page.evaluate(([step, s]) => window.bare?.turn(step, s), [stepRad, seconds] as const);
    await turnBare(warmS);
    const turned = await turnBare(turnS);
    if (turned !== undefined) others.push(rate(turned));
    await page.context().close();
    tell(`pictures a second: ours ${ours.at(-1)?.toFixed(1) ?? ''}, bare ${others.at(-1)?.toFixed(1) ?? ''}`);
  }
  return { ours: median(ours), bare: median(others), ...figures };
}
