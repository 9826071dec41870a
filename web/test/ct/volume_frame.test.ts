import { describe, expect, it } from 'vitest';

import { length, subtract } from '../../src/ct/volume_frame';
import type { Triple } from '../../src/wire/rest_types';
import { frameOf, random, straight, turned } from './frames';

describe('VolumeFrame', () => {
  it('puts the corner of the volume at the translation, and the next voxel a spacing further', () => {
    const frame = frameOf(straight);
    expect(frame.worldFromVoxel([0, 0, 0])).toEqual([-12, 34, -56]);
    expect(frame.worldFromVoxel([1, 1, 1])).toEqual([-11.5, 34.75, -54]);
  });

  it('goes from voxels to the world and back, whichever way the volume lies', () => {
    const seed = 7;
    const next = random(seed);
    for (let n = 0; n < 200; ++n) {
      const frame = frameOf(turned(next() * 6, next() * 6, next() * 6));
      const voxel: Triple = [next() * 40, next() * 50, next() * 60];
      const back = frame.voxelFromWorld(frame.worldFromVoxel(voxel));
      expect(length(subtract(back, voxel)), `seed ${seed}`).toBeLessThan(1e-9);
    }
  });

  it('keeps distances of the spacing when turned', () => {
    const frame = frameOf(turned(0.3, -1, 2));
    const step = subtract(frame.worldFromVoxel([3, 4, 6]), frame.worldFromVoxel([3, 4, 5]));
    expect(length(step)).toBeCloseTo(2, 12);
  });

  it('names the slice a place lies in, and the outermost for places outside', () => {
    const frame = frameOf(straight);
    expect(frame.sliceAt('w', [0, 0, 12.99])).toBe(12);
    expect(frame.sliceAt('w', [0, 0, -3])).toBe(0);
    expect(frame.sliceAt('w', [0, 0, 99])).toBe(59);
    expect(frame.clampVoxel([-5, 20, 99])).toEqual([0.5, 20, 59.5]);
  });

  it('gives the corners of a slice within a box', () => {
    const corners = frameOf(straight).sliceCorners('v', [1, 20, 3], [0, 0, 0], [40, 50, 60]);
    expect(corners).toEqual([
      [-12, 49, -56],
      [8, 49, -56],
      [8, 49, 64],
      [-12, 49, 64],
    ]);
  });
});
