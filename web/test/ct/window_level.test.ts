import { describe, expect, it } from 'vitest';

import { paintSlice } from '../../src/ct/paint_slice';
import { partColours, previewColour } from '../../src/ct/palette';
import { brightness, brightnessTable, limitWindow, windowPresets } from '../../src/ct/window_level';

describe('window and level', () => {
  const window = { widthHu: 400, levelHu: 50 };

  it('is black below, white above and linear between', () => {
    expect(brightness(-151, window)).toBe(0);
    expect(brightness(-150, window)).toBe(0);
    expect(brightness(50, window)).toBe(128);
    expect(brightness(250, window)).toBe(255);
    expect(brightness(3000, window)).toBe(255);
  });

  it('never gets darker with more HU, and its table says the same', () => {
    const table = brightnessTable(windowPresets.bone);
    for (let hu = -32768; hu < 32767; ++hu) {
      expect(table[hu + 32768]).toBe(brightness(hu, windowPresets.bone));
      expect(table[hu + 32769] as number).toBeGreaterThanOrEqual(table[hu + 32768] as number);
      if (hu < -2000 || hu > 4000) hu += 97;
    }
  });

  it('stays within what can be shown', () => {
    expect(limitWindow({ widthHu: -3, levelHu: 99999 })).toEqual({ widthHu: 20, levelHu: 3500 });
  });
});

describe('paintSlice', () => {
  const hu = Int16Array.from([-1000, 0, 300, 300, 300, 300, 300, 300, 300]);
  const grey = brightnessTable({ widthHu: 2000, levelHu: 0 });
  const paint = (options: Partial<Parameters<typeof paintSlice>[1]>, labels: number[] | null) => {
    const out = new Uint8ClampedArray(36);
    const slice = { columns: 3, rows: 3, hu, labels: labels === null ? null : Uint8Array.from(labels) };
    paintSlice(slice, { brightness: grey, previewFromHu: null, showLabels: true, ...options }, out);
    return (i: number) => [...out.subarray(i * 4, i * 4 + 4)];
  };

  it('is grey without parts and preview', () => {
    const pixel = paint({}, null);
    expect(pixel(0)).toEqual([0, 0, 0, 255]);
    expect(pixel(1)).toEqual([128, 128, 128, 255]);
  });

  it('tints from the threshold on', () => {
    const pixel = paint({ previewFromHu: 300 }, null);
    expect(pixel(1)).toEqual([128, 128, 128, 255]);
    const [red = 0, green = 0, blue = 0] = pixel(2);
    expect([Math.sign(red - green), Math.sign(green - blue)]).toEqual([1, 1]);
    expect(previewColour[2]).toBeLessThan(blue);
  });

  it('draws the edge of a part stronger than its area, and parts over the preview', () => {
    const pixel = paint({ previewFromHu: -2000 }, [1, 1, 1, 1, 1, 1, 2, 2, 2]);
    const towards = (i: number) => Math.abs((pixel(i)[2] ?? 0) - (partColours[1]?.[2] ?? 0));
    expect(towards(4)).toBeLessThan(towards(1));
    expect(towards(1)).not.toBe(towards(4));
  });

  it('leaves parts out when they are not to be seen', () => {
    expect(paint({ showLabels: false }, [1, 1, 1, 1, 1, 1, 1, 1, 1])(1)).toEqual([128, 128, 128, 255]);
  });
});
