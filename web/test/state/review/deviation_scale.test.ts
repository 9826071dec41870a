import { describe, expect, it } from 'vitest';

import {
  classOf,
  deviationClasses,
  deviationMm,
  deviationShares,
  paletteOf,
  scaleOf,
  type ScaleName,
  scaleBoundsMm,
  unknownColour,
} from '../../../src/state/review/deviation_scale';
import type { DeviationCode } from '../../../src/wire/review_api';

const code: DeviationCode = { stepMm: 1 / 32, rangeMm: 127 / 32, unknown: -128 };
const scales = Object.keys(scaleBoundsMm) as ScaleName[];

/** Brightness as the eye has it, 0 to 1 (sRGB's luma is near enough to compare). */
const luma = ([r, g, b]: readonly number[]) => (0.2126 * (r ?? 0) + 0.7152 * (g ?? 0) + 0.0722 * (b ?? 0)) / 255;

describe('scale of deviations', () => {
  it('has a class for every deviation, without gaps and in order', () => {
    for (const scale of scales) {
      const classes = deviationClasses(scale);
      expect(classes[0]?.fromMm).toBe(-Infinity);
      expect(classes.at(-1)?.toMm).toBe(Infinity);
      classes.slice(1).forEach(({ fromMm }, i) => expect(fromMm).toBe(classes[i]?.toMm));
      for (let mm = -5; mm <= 5; mm += 0.01) {
        const { fromMm, toMm } = classOf(mm, classes);
        expect(mm > fromMm && mm <= toMm).toBe(true);
      }
    }
  });

  it('is the same on both sides but for colour and hatching', () => {
    for (const scale of scales) {
      const classes = deviationClasses(scale);
      classes.forEach((each, i) => {
        const mirrored = classes[classes.length - 1 - i];
        expect(each.fromMm).toBe(-(mirrored?.toMm ?? NaN));
        expect(each.hatched).toBe(each.side === 'beyond');
      });
      expect(classes.find(({ side }) => side === 'even')).toMatchObject({ fromMm: -scaleBoundsMm[scale][0] });
    }
  });

  it('grows darker away from the plan, so that it is read without seeing colours', () => {
    const brightness = deviationClasses('report').map(({ colour }) => luma(colour));
    const middle = 3;
    for (let i = 0; i < middle; ++i) expect(brightness[i]).toBeLessThan(brightness[i + 1] ?? 0);
    for (let i = middle; i + 1 < brightness.length; ++i) expect(brightness[i]).toBeGreaterThan(brightness[i + 1] ?? 1);
  });

  it('tells proud from beyond by more blue or more red, which no colour blindness confuses', () => {
    for (const { side, colour } of deviationClasses('report')) {
      const [red, , blue] = colour;
      if (side === 'proud') expect(red - blue).toBeGreaterThan(60);
      if (side === 'beyond') expect(blue - red).toBeGreaterThan(15);
    }
  });

  it('paints bytes as what they mean, and nothing to compare as bone', () => {
    for (const scale of scales) {
      const palette = paletteOf(scale, code);
      const classes = deviationClasses(scale);
      for (let byte = -127; byte < 128; ++byte) {
        const { colour, hatched } = classOf(byte / 32, classes);
        const at = (byte + 128) * 4;
        expect([...palette.slice(at, at + 4)]).toEqual([...colour, hatched ? 255 : 0]);
      }
      expect([...palette.slice(0, 3)]).toEqual([...unknownColour]);
    }
    expect(deviationMm(-128, code)).toBeNull();
    expect(deviationMm(64, code)).toBe(2);
  });

  it('paints a wall by its own classes, the thinner the darker', () => {
    expect(scaleOf('wall', 'fine')).toBe('wall');
    expect(scaleOf('plan', 'fine')).toBe('fine');
    const classes = deviationClasses('wall');
    classes.slice(1).forEach(({ fromMm, colour }, i) => {
      expect(fromMm).toBe(classes[i]?.toMm);
      expect(luma(colour)).toBeGreaterThan(luma(classes[i]?.colour ?? []));
    });
    expect(classes.map(({ hatched }) => hatched)).toEqual([true, false, false, false, false]);
    const steps: DeviationCode = { stepMm: 0.25, rangeMm: 31.75, unknown: -128 };
    const { classes: shares } = deviationShares(Int8Array.from([0, 8, 9, 20, 127, -128]), 'wall', steps);
    expect(shares).toEqual([2 / 5, 2 / 5, 0, 0, 1 / 5]);
  });

  it('takes the byte for nothing to compare from the server', () => {
    const other = { ...code, unknown: 127 };
    expect(deviationMm(127, other)).toBeNull();
    expect(deviationMm(-128, other)).toBe(-4);
    expect([...paletteOf('report', other).slice(255 * 4, 255 * 4 + 3)]).toEqual([...unknownColour]);
  });

  it('says how much of a surface lies in each class', () => {
    const bytes = Int8Array.from([0, 0, 4, 127, -127, -128, -128, -128, -128, 12]);
    const { classes, known, beyondRange } = deviationShares(bytes, 'report', code);
    expect(known).toBe(6);
    expect(beyondRange).toBe(2);
    expect(classes.reduce((sum, share) => sum + share, 0)).toBeCloseTo(1);
    expect(classes[3]).toBeCloseTo(3 / 6);
    expect(classes[6]).toBeCloseTo(1 / 6);
    expect(classes[0]).toBeCloseTo(1 / 6);
    expect(deviationShares(Int8Array.from([-128]), 'fine', code).classes).toEqual([0, 0, 0, 0, 0, 0, 0]);
  });
});
