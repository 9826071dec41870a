import type { Locator, Page } from '@playwright/test';

/** A picture of an element as the browser shows it. */
export async function picture(element: Locator): Promise<string> {
  return (await element.screenshot({ animations: 'disabled' })).toString('base64');
}

/** A picture of the bone's canvas alone: without what stands over it, which changes with the tools, and outlines. */
export async function pictureOfBone(canvas: Locator): Promise<string> {
  const page = canvas.page();
  // The page's own rules let no style element in.
  await page.evaluate(() => {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(
      '.picture > :not(.canvas-place) { visibility: hidden !important; } * { outline: none !important; }',
    );
    document.adoptedStyleSheets.push(sheet);
  });
  try {
    return await picture(canvas);
  } finally {
    await page.evaluate(() => void document.adoptedStyleSheets.pop());
  }
}

/** Of the pixels of a picture, taken by `pictureOfBone` or `picture`, the relative luminance (WCAG 2), 0 to 1. */
async function luminances(page: Page, base64: string): Promise<number[]> {
  return page.evaluate(async (data) => {
    const bytes = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
    if (context === null) throw new Error('no 2d canvas');
    context.drawImage(bitmap, 0, 0);
    const pixels = context.getImageData(0, 0, bitmap.width, bitmap.height).data;
    const linear = (byte = 0) => (byte <= 10 ? byte / 3294.6 : ((byte / 255 + 0.055) / 1.055) ** 2.4);
    const found: number[] = [];
    for (let i = 0; i < pixels.length; i += 4)
      found.push(0.2126 * linear(pixels[i]) + 0.7152 * linear(pixels[i + 1]) + 0.0722 * linear(pixels[i + 2]));
    return found;
  }, base64);
}

/** Pixels that have become darker with at least that contrast. */
export async function darkened(page: Page, now: string, before: string, contrast: number): Promise<number> {
  const [a, b] = [await luminances(page, now), await luminances(page, before)];
  return a.filter((value, i) => ((b[i] ?? 0) + 0.05) / (value + 0.05) >= contrast).length;
}

/** Standard deviation of the luminances of a picture. */
export async function luminanceSpread(page: Page, base64: string): Promise<number> {
  const values = await luminances(page, base64);
  const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
  return Math.sqrt(values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / values.length);
}

export interface PictureFacts {
  /** Pixels in all. */
  pixels: number;
  /** Pixels of bone: warm, red over blue, which the bluish stage and the reamer are not. */
  bone: number;
  /** Pixels that differ from the other picture by more than a little noise. */
  changed: number;
}

/** Looks at a picture and how it differs from another of the same size. */
export function compare(page: Page, now: string, before = now): Promise<PictureFacts> {
  return page.evaluate(
    async ([first, second]) => {
      const read = async (base64: string) => {
        const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
        const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
        const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
        if (context === null) throw new Error('no 2d canvas');
        context.drawImage(bitmap, 0, 0);
        return context.getImageData(0, 0, bitmap.width, bitmap.height).data;
      };
      const [a, b] = [await read(first), await read(second)];
      let bone = 0;
      let changed = 0;
      for (let i = 0; i < a.length; i += 4) {
        const [red = 0, green = 0, blue = 0] = a.subarray(i, i + 3);
        if (red > blue + 15) ++bone;
        const difference =
          Math.abs(red - (b[i] ?? 0)) + Math.abs(green - (b[i + 1] ?? 0)) + Math.abs(blue - (b[i + 2] ?? 0));
        if (difference > 24) ++changed;
      }
      return { pixels: a.length / 4, bone, changed };
    },
    [now, before] as const,
  );
}
