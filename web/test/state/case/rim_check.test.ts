import { describe, expect, it } from 'vitest';

import type { PlacedLandmarks } from '../../../src/state/case/landmark_names';
import { checkCentre, farFromMiddleMm } from '../../../src/state/case/rim_check';
import type { Triple } from '../../../src/wire/rest_types';

/** A face 36 mm high and 26 mm wide across x, in a frame turned about z. */
function face(centre: Triple): PlacedLandmarks {
  const turned = ([x, y, z]: Triple): Triple => [0.6 * x - 0.8 * y + 40, 0.8 * x + 0.6 * y - 7, z + 100];
  return {
    superior_rim_mm: turned([0, 0, 18]),
    inferior_rim_mm: turned([0, 0, -18]),
    anterior_rim_mm: turned([0, -13, 0]),
    posterior_rim_mm: turned([0, 13, 0]),
    glenoid_centre_mm: turned(centre),
  };
}

describe('the glenoid’s centre', () => {
  it('is measured across the face only: a hollow face is no fault', () => {
    expect(checkCentre(face([0, 0, 0]))?.offMm).toBeCloseTo(0, 9);
    expect(checkCentre(face([3.5, 0, 0]))?.offMm).toBeCloseTo(0, 9);
    expect(checkCentre(face([3.5, -3, 4]))?.offMm).toBeCloseTo(5, 9);
  });

  it('is near the front of the rim: far off; the middle of the rim keeps its depth', () => {
    const check = checkCentre(face([2, -11, 1]));
    expect(check?.offMm).toBeGreaterThan(farFromMiddleMm);
    const mended = face([2, 0, 0]).glenoid_centre_mm ?? [];
    check?.middle.forEach((value, i) => expect(value).toBeCloseTo(mended[i] ?? NaN, 9));
  });

  it('is not judged while a point is missing, or where the rim is a line', () => {
    expect(checkCentre({ ...face([0, 0, 0]), anterior_rim_mm: undefined })).toBeNull();
    const flat = face([0, 0, 0]);
    expect(
      checkCentre({ ...flat, anterior_rim_mm: flat.superior_rim_mm, posterior_rim_mm: flat.inferior_rim_mm }),
    ).toBeNull();
  });
});
