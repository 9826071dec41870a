import { describe, expect, it } from 'vitest';

import { plannedReamerText, reamerText } from '../../../src/panels/case/reamer_text';
import type { Reamer } from '../../../src/wire/rest_types';

const convex = { name: 'convex-40', words: 'sphere 40,16 nipple 3,8', diameter_mm: 32, radius_mm: 40 } as Reamer;
const flat = { name: 'flat-30', words: 'sphere 1000,15 nipple 3,8', diameter_mm: 30, radius_mm: 1000 } as Reamer;

describe('a reamer', () => {
  it('has a radius unless it is flat', () => {
    expect(reamerText(convex)).toBe('convex-40: ⌀ 32.0 mm, radius 40.0 mm');
    expect(reamerText(flat)).toBe('flat-30: ⌀ 30.0 mm');
  });

  it('of a plan is named as in the library, whichever way the plan says it', () => {
    for (const planned of [convex.name, convex.words])
      expect(plannedReamerText(planned, [flat, convex])).toBe(reamerText(convex));
    expect(plannedReamerText('ellipse 16,8', [flat, convex])).toBe('ellipse 16,8');
    expect(plannedReamerText(convex.words, [])).toBe(convex.words);
  });
});
