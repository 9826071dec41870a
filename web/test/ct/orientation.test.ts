import { describe, expect, it } from 'vitest';

import { directionLetters, planeNames, slicePlanes } from '../../src/ct/orientation';
import { fittingLook, SliceLayout } from '../../src/ct/slice_layout';
import { length, subtract } from '../../src/ct/volume_frame';
import type { Triple } from '../../src/wire/rest_types';
import { frameOf, random, straight, turned } from './frames';

describe('directionLetters', () => {
  it('names the six directions of LPS', () => {
    const named: [Triple, string][] = [
      [[1, 0, 0], 'L'],
      [[-1, 0, 0], 'R'],
      [[0, 1, 0], 'P'],
      [[0, -1, 0], 'A'],
      [[0, 0, 1], 'S'],
      [[0, 0, -1], 'I'],
    ];
    for (const [direction, letter] of named) expect(directionLetters(direction)).toBe(letter);
  });

  it('names a second direction only where it leans far towards it', () => {
    const at = (degrees: number): Triple => [
      Math.cos((degrees * Math.PI) / 180),
      0,
      Math.sin((degrees * Math.PI) / 180),
    ];
    expect(directionLetters(at(20))).toBe('L');
    expect(directionLetters(at(30))).toBe('LS');
    expect(directionLetters(at(60))).toBe('SL');
    expect(directionLetters(at(-70))).toBe('I');
  });
});

describe('slicePlanes', () => {
  it('shows a straight CT as radiologists do', () => {
    const planes = slicePlanes(frameOf(straight));
    expect(planes.axial).toMatchObject({ axis: 'w', letters: { left: 'R', right: 'L', top: 'A', bottom: 'P' } });
    expect(planes.coronal).toMatchObject({ axis: 'v', letters: { left: 'R', right: 'L', top: 'S', bottom: 'I' } });
    expect(planes.sagittal).toMatchObject({ axis: 'u', letters: { left: 'A', right: 'P', top: 'S', bottom: 'I' } });
  });

  it('shows the same letters however the voxels were stored', () => {
    const quarter = Math.PI / 2;
    for (let x = 0; x < 4; ++x)
      for (let y = 0; y < 4; ++y)
        for (let z = 0; z < 4; ++z) {
          const planes = slicePlanes(frameOf(turned(x * quarter, y * quarter, z * quarter)));
          expect(planes.axial.letters).toEqual({ left: 'R', right: 'L', top: 'A', bottom: 'P' });
          expect(planes.coronal.letters).toEqual({ left: 'R', right: 'L', top: 'S', bottom: 'I' });
          expect(planes.sagittal.letters).toEqual({ left: 'A', right: 'P', top: 'S', bottom: 'I' });
          expect(new Set(planeNames.map((name) => planes[name].axis)).size).toBe(3);
        }
  });
});

describe('SliceLayout', () => {
  const seed = 11;
  const next = random(seed);
  const cases = Array.from({ length: 40 }, () => {
    const frame = frameOf(turned(next() * 6, next() * 6, next() * 6));
    const plane = slicePlanes(frame)[planeNames[Math.floor(next() * 3)] ?? 'axial'];
    const layout = new SliceLayout(frame, plane, fittingLook(frame, plane, 420, 280), 420, 280);
    return { frame, plane, layout };
  });

  it('finds the place under a point of the picture', () => {
    for (const { layout } of cases) {
      const voxel: Triple = [next() * 40, next() * 50, next() * 60];
      const back = layout.toVoxel(layout.toPicture(voxel), voxel);
      expect(length(subtract(back, voxel)), `seed ${seed}`).toBeLessThan(1e-9);
    }
  });

  it('shows the whole slice, and a millimetre as long both ways', () => {
    for (const { frame, layout, plane } of cases) {
      const across = layout.toPicture([40, 50, 60]);
      const corner = layout.toPicture([0, 0, 0]);
      const [width, height] = [Math.abs(across.x - corner.x), Math.abs(across.y - corner.y)];
      expect(Math.max(width / 420, height / 280)).toBeCloseTo(1, 9);
      const mm = { u: 20, v: 37.5, w: 120 };
      expect(width / mm[plane.right.axis]).toBeCloseTo(height / mm[plane.down.axis], 9);
      expect(frame.dims).toEqual([40, 50, 60]);
    }
  });

  it('keeps what is under the pointer there while zooming', () => {
    for (const { layout, frame, plane } of cases) {
      const at = { x: next() * 420, y: next() * 280 };
      const voxel = layout.toVoxel(at, [5, 5, 5]);
      const zoomed = new SliceLayout(frame, plane, layout.zoomedAt(at, 1.7), 420, 280).toPicture(voxel);
      expect(zoomed.x).toBeCloseTo(at.x, 6);
      expect(zoomed.y).toBeCloseTo(at.y, 6);
    }
  });

  it('draws the pixels of a slice where their places are', () => {
    for (const { layout, plane } of cases) {
      const [a, b, c, d, e, f] = layout.transform();
      const voxel: Triple = [3, 7, 11];
      const [first, second] = (['u', 'v', 'w'] as const).filter((axis) => axis !== plane.axis);
      const place = { u: 3, v: 7, w: 11 };
      const column = place[first ?? 'u'];
      const row = place[second ?? 'v'];
      const { x, y } = layout.toPicture(voxel);
      expect(a * column + c * row + e).toBeCloseTo(x, 9);
      expect(b * column + d * row + f).toBeCloseTo(y, 9);
    }
  });
});
