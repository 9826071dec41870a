import { describe, expect, it } from 'vitest';

import { reamerOutline } from '../../src/ct/reamer_shape';

describe('reamerOutline', () => {
  it('lies on a sphere of the radius from the apex to the rim', () => {
    const outline = reamerOutline({ diameter_mm: 36.5, radius_mm: 37 });
    expect(outline[0]).toEqual({ offAxisMm: 0, behindMm: 0 });
    expect(outline.at(-1)?.offAxisMm).toBeCloseTo(18.25, 12);
    for (const { offAxisMm, behindMm } of outline) expect(Math.hypot(offAxisMm, 37 - behindMm)).toBeCloseTo(37, 9);
  });

  it('is flat where no sphere fits', () => {
    expect(reamerOutline(undefined).every(({ behindMm }) => behindMm === 0)).toBe(true);
    expect(reamerOutline({ diameter_mm: 40, radius_mm: 10 }).every(({ behindMm }) => behindMm === 0)).toBe(true);
  });
});
