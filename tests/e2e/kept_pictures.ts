// How pages look, kept as small pictures. They are compared coarsely: a panel that is gone, moved or of another colour is
// found; digits, a font's edges and the moment at which a session was paused are not.
import { expect, type Page } from '@playwright/test';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

const folder = join(__dirname, 'pictures');
/** Of the 320 x 180 points of a kept picture so many may differ. */
export const differsAtMost = 0.04;
/** Set to keep how pages look now. */
const keepsNew = process.env.REAM_NEW_PICTURES === '1';

/** `picture` as base64 PNG, made small. */
export async function small(page: Page, picture: string): Promise<string> {
  return page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const whole = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const paper = new OffscreenCanvas(320, Math.round((320 * whole.height) / whole.width));
    const ink = paper.getContext('2d');
    if (ink === null) throw new Error('no canvas');
    ink.imageSmoothingQuality = 'high';
    ink.drawImage(whole, 0, 0, paper.width, paper.height);
    const made = new Uint8Array(await (await paper.convertToBlob({ type: 'image/png' })).arrayBuffer());
    let text = '';
    for (const byte of made) text += String.fromCharCode(byte);
    return btoa(text);
  }, picture);
}

/** The share of points that differ clearly between two small pictures; 1 where they are not of one size. */
export async function difference(page: Page, first: string, second: string): Promise<number> {
  return page.evaluate(
    async (both) => {
      const [a, b] = await Promise.all(
        both.map(async (base64) => {
          const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
          const whole = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
          const ink = new OffscreenCanvas(whole.width, whole.height).getContext('2d');
          if (ink === null) throw new Error('no canvas');
          ink.drawImage(whole, 0, 0);
          return ink.getImageData(0, 0, whole.width, whole.height);
        }),
      );
      if (a === undefined || b === undefined || a.width !== b.width || a.height !== b.height) return 1;
      const clearly = 28;
      let differing = 0;
      for (let i = 0; i < a.data.length; i += 4) {
        const by = Math.max(...[0, 1, 2].map((c) => Math.abs((a.data[i + c] ?? 0) - (b.data[i + c] ?? 0))));
        if (by > clearly) ++differing;
      }
      return differing / (a.width * a.height);
    },
    [first, second],
  );
}

/** Fails softly where more than `atMost` of the page does not look as it was kept; the small picture is returned. */
export async function expectKeptLook(
  page: Page,
  name: string,
  png: Buffer,
  atMost: number = differsAtMost,
): Promise<string> {
  const now = await small(page, png.toString('base64'));
  const file = join(folder, `${name}.png`);
  if (keepsNew) {
    mkdirSync(folder, { recursive: true });
    writeFileSync(file, Buffer.from(now, 'base64'));
    return now;
  }
  expect.soft(existsSync(file), `${name} has no kept picture: run with REAM_NEW_PICTURES=1, and look at it`).toBe(true);
  if (!existsSync(file)) return now;
  const differs = await difference(page, now, readFileSync(file).toString('base64'));
  expect.soft(differs, `${name} looks otherwise than tests/e2e/pictures/${name}.png`).toBeLessThan(atMost);
  return now;
}
