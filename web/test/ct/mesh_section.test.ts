import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';

import { meshSection } from '../../src/ct/mesh_section';

/** A ball of a radius around the origin, as rings of triangles. */
function ball(radius: number, rings: number) {
  const positions: number[] = [];
  const indices: number[] = [];
  for (let ring = 0; ring <= rings; ++ring)
    for (let side = 0; side < 2 * rings; ++side) {
      const [polar, around] = [(Math.PI * ring) / rings, (Math.PI * side) / rings];
      positions.push(radius * Math.sin(polar) * Math.cos(around), radius * Math.sin(polar) * Math.sin(around));
      positions.push(radius * Math.cos(polar));
      if (ring === rings) continue;
      const at = (r: number, s: number) => r * 2 * rings + (s % (2 * rings));
      indices.push(at(ring, side), at(ring + 1, side), at(ring, side + 1));
      indices.push(at(ring, side + 1), at(ring + 1, side), at(ring + 1, side + 1));
    }
  return { positionsMm: Float32Array.from(positions), indices: Uint32Array.from(indices) };
}

const points = (pieces: number[]) =>
  Array.from({ length: pieces.length / 3 }, (_, i) => new Vector3().fromArray(pieces, i * 3));

describe('the outline of a mesh in a slice', () => {
  const mesh = ball(18, 48);

  it('is a closed circle of the right size in the plane, for a ball', () => {
    for (const [normal, at] of [
      [new Vector3(0, 0, 1), 5],
      [new Vector3(1, -2, 0.5).normalize(), -7.3],
    ] as const) {
      const through = normal.clone().multiplyScalar(at);
      const found = points(meshSection(mesh, normal, through));
      const radius = Math.sqrt(18 * 18 - at * at);
      let length = 0;
      found.forEach((point, i) => {
        expect(point.dot(normal)).toBeCloseTo(at, 3);
        expect(Math.abs(point.distanceTo(through) - radius)).toBeLessThan(0.1);
        if (i % 2 === 1) length += point.distanceTo(found[i - 1] ?? point);
      });
      expect(length / (2 * Math.PI * radius)).toBeGreaterThan(0.99);
      expect(length / (2 * Math.PI * radius)).toBeLessThan(1.001);
    }
  });

  it('is nothing where the plane misses it', () => {
    expect(meshSection(mesh, new Vector3(0, 1, 0), new Vector3(0, 18.2, 0))).toEqual([]);
    expect(
      meshSection({ positionsMm: new Float32Array(), indices: new Uint32Array() }, new Vector3(0, 0, 1), new Vector3()),
    ).toEqual([]);
  });
});
