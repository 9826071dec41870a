import { describe, expect, it } from 'vitest';

import { wallLimitFormula } from '../../src/scene/pores';
import { randomNumbers } from './random_surfaces';

/** Differences of the distances to the two nearest of points strewn one a cell, at places drawn at random; ascending. */
function offWalls(count: number, random: () => number): number[] {
  const edge = 24;
  const points = Array.from({ length: edge ** 3 }, () => [random(), random(), random()]);
  const inCell = (x: number, y: number, z: number) => points[x + edge * (y + edge * z)] ?? [0, 0, 0];
  const at = () => 2 + (edge - 4) * random();
  return Array.from({ length: count }, () => offWall([at(), at(), at()], inCell)).sort((a, b) => a - b);
}

/** Of the points in the cell of a place and in those around it, which all of the nearest need not be in. */
function offWall(at: readonly number[], inCell: (x: number, y: number, z: number) => number[]): number {
  const far: number[] = [];
  const [x = 0, y = 0, z = 0] = at.map(Math.floor);
  for (let u = x - 1; u <= x + 1; ++u)
    for (let v = y - 1; v <= y + 1; ++v)
      for (let w = z - 1; w <= z + 1; ++w) {
        const point = inCell(u, v, w);
        far.push(Math.hypot(...[u, v, w].map((cell, axis) => cell + (point[axis] ?? 0) - (at[axis] ?? 0))));
      }
  const [first = 0, second = 0] = far.sort((a, b) => a - b);
  return second - first;
}

/** The formula's coefficients, from the innermost bracket outwards, as the shader computes it. */
function wallLimit(share: number): number {
  const form = /^share \* \(([\d.]+) \+ share \* \(([\d.]+) \+ share \* ([\d.]+)\)\)$/;
  const [, first, second, third] = (form.exec(wallLimitFormula) ?? []).map(Number);
  return share * ((first ?? NaN) + share * ((second ?? NaN) + share * (third ?? NaN)));
}

describe('Walls between pores', () => {
  it('take the share of space that is bone', () => {
    const values = offWalls(40_000, randomNumbers(11));
    for (const share of [0.1, 0.2, 0.3, 0.45, 0.6, 0.7]) {
      const limit = wallLimit(share);
      const measured = values.filter((value) => value < limit).length / values.length;
      expect(Math.abs(measured - share), `share ${share}`).toBeLessThan(0.015);
    }
    expect(wallLimit(0)).toBe(0);
  });
});
