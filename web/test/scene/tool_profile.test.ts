import { BoxGeometry, TorusGeometry } from 'three';
import { describe, expect, it } from 'vitest';

import { faceHeightMm, profileOf } from '../../src/scene/tool_profile';
import { libraryOutlines, revolved } from './library_tools';

const named = (name: string) => libraryOutlines[name] ?? [];

describe('profileOf', () => {
  it.each(Object.entries(libraryOutlines))('finds face, rim and back of %s', (_, outline) => {
    const profile = profileOf(revolved(outline));
    const rimMm = Math.max(...outline.map(([off]) => off));
    expect(profile?.rimMm).toBeCloseTo(rimMm, 4);
    expect(profile?.backZMm).toBeCloseTo(outline.at(-4)?.[1] ?? NaN, 4);
    const rim = outline.findIndex(([off]) => off === rimMm);
    outline.slice(0, rim + 1).forEach(([off, z], i) => {
      if (profile === null || off < (profile.nipple.at(-1)?.offMm ?? 0) || i < profile.nipple.length - 1) return;
      expect(faceHeightMm(profile, off)).toBeCloseTo(z, 4);
    });
  });

  it('knows a nipple from a face', () => {
    expect(profileOf(revolved(named('convex-30')))?.nipple.map(({ zMm }) => zMm > 1)).toEqual([true, true, false]);
    // Its face falls steeply, too, but at the rim.
    expect(profileOf(revolved(named('thesis-appendix-a')))?.nipple).toEqual([]);
    expect(profileOf(revolved(named('cannulated-40')))?.nipple).toEqual([]);
  });

  it('knows the order of an outline however its triangles are sorted and its corners repeated', () => {
    const { positionsMm, indices } = revolved(named('convex-60'));
    const count = indices.length;
    const apart = {
      name: 'file',
      positionsMm: Float32Array.from(indices, () => 0),
      indices: Uint32Array.from(indices.keys()),
    };
    apart.positionsMm = new Float32Array(3 * count);
    for (let i = 0; i < count; ++i)
      for (let k = 0; k < 3; ++k)
        apart.positionsMm[3 * i + k] = positionsMm[3 * (indices[count - 1 - i] ?? 0) + k] ?? 0;
    expect(profileOf(apart)).toEqual(profileOf(revolved(named('convex-60'))));
  });

  it('takes nothing for a reamer that is none', () => {
    const meshOf = (geometry: BoxGeometry | TorusGeometry) => ({
      name: 'file',
      positionsMm: Float32Array.from(geometry.getAttribute('position').array),
      indices: Uint32Array.from(geometry.getIndex()?.array ?? []),
    });
    expect(profileOf(meshOf(new BoxGeometry(20, 20, 8, 6, 6, 2)))).toBeNull();
    expect(profileOf(meshOf(new TorusGeometry(15, 3, 12, 96)))).toBeNull();
    expect(profileOf({ name: '', positionsMm: new Float32Array(), indices: new Uint32Array() })).toBeNull();
    // One lip that stands out of it.
    const lipped = revolved(named('convex-30'));
    lipped.positionsMm[3 * 400] = (lipped.positionsMm[3 * 400] ?? 0) * 1.1;
    expect(profileOf(lipped)).toBeNull();
    // Six flat sides are seen as such.
    expect(profileOf(revolved(named('convex-30'), 6))).toBeNull();
    // A ball has no wall behind its rim.
    expect(
      profileOf(
        revolved([
          [0, 0],
          [3, -1],
          [5, -5],
          [3, -9],
          [0, -10],
        ]),
      ),
    ).toBeNull();
  });
});
