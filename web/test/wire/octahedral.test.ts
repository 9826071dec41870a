import { describe, expect, it } from 'vitest';

import { octahedralToUnit, stretchedNormals } from '../../src/wire/octahedral';

describe('octahedralToUnit', () => {
  it('puts the axes and their opposites where they belong', () => {
    expect(octahedralToUnit(0, 0)).toEqual([0, 0, 1]);
    expect(octahedralToUnit(1, 0)).toEqual([1, 0, 0]);
    expect(octahedralToUnit(0, -1)).toEqual([0, -1, 0]);
    const [x, y, z] = octahedralToUnit(1, 1);
    expect([Math.abs(x), Math.abs(y), z]).toEqual([0, 0, -1]);
  });

  it('undoes the projection of any direction', () => {
    for (let i = 0; i < 2000; ++i) {
      const z = 1 - (2 * (i + 0.5)) / 2000;
      const radius = Math.sqrt(1 - z * z);
      const n = [radius * Math.cos(i * 2.4), radius * Math.sin(i * 2.4), z] as const;
      const [x, y, w] = octahedralToUnit(...project(n));
      expect(x).toBeCloseTo(n[0], 12);
      expect(y).toBeCloseTo(n[1], 12);
      expect(w).toBeCloseTo(n[2], 12);
    }
  });
});

describe('stretchedNormals', () => {
  it('gives unit normals in mm once divided by the spacing', () => {
    const spacing = [0.5, 0.25, 1] as const;
    const vertices = new Uint8Array(16);
    vertices.set([40, 216], 6); // -40 as a signed byte
    vertices.set([129, 127], 14);
    const normals = stretchedNormals(vertices, 2, spacing);
    for (const [i, pair] of [
      [0, [40 / 127, -40 / 127]],
      [1, [-1, 1]],
    ] as const) {
      const drawn = [0, 1, 2].map((axis) => (normals[4 * i + axis] ?? 0) / (spacing[axis] ?? 1));
      const length = Math.hypot(...drawn);
      const truth = octahedralToUnit(pair[0], pair[1]);
      for (const axis of [0, 1, 2]) expect((drawn[axis] ?? 0) / length).toBeCloseTo(truth[axis] ?? 0, 3);
    }
  });
});

/** The textbook forward projection. */
function project([x, y, z]: readonly [number, number, number]): [number, number] {
  const sum = Math.abs(x) + Math.abs(y) + Math.abs(z);
  const [u, v] = [x / sum, y / sum];
  if (z >= 0) return [u, v];
  return [(1 - Math.abs(v)) * (u >= 0 ? 1 : -1), (1 - Math.abs(u)) * (v >= 0 ? 1 : -1)];
}
