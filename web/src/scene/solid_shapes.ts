import { BufferAttribute, BufferGeometry } from 'three';
import { toCreasedNormals } from 'three/examples/jsm/utils/BufferGeometryUtils.js';

import type { MeridianPoint } from './meridian';

type Place = readonly [x: number, y: number, z: number];
/** Rows of places, all of the same length. */
export type Grid = readonly (readonly Place[])[];

/** Edges that are sharper stay edges. */
export const creaseRad = 0.6;

export const turned = (offMm: number, angle: number, zMm: number): Place => [
  offMm * Math.cos(angle),
  offMm * Math.sin(angle),
  zMm,
];

/** Solids that are put together to one shape; seen from outside their corners go counter-clockwise. */
export class SolidShapes {
  private readonly corners: number[] = [];

  /** An outline turned around z, given from the front of what is solid, by its outside, to the back. */
  addTurned(outline: readonly MeridianPoint[], sides: number): void {
    for (let i = 1; i < outline.length; ++i) {
      const [from, to] = [outline[i - 1], outline[i]] as [MeridianPoint, MeridianPoint];
      for (let side = 0; side < sides; ++side) {
        const [here, next] = [side, side + 1].map((n) => (2 * Math.PI * n) / sides) as [number, number];
        this.addFour(
          turned(from.offMm, here, from.zMm),
          turned(to.offMm, here, to.zMm),
          turned(to.offMm, next, to.zMm),
          turned(from.offMm, next, from.zMm),
        );
      }
    }
  }

  /** A plate with its four sides. Rows go outwards from z, and columns around it by angles that grow. */
  addPlate(front: Grid, back: Grid): void {
    const across = (grid: Grid, column: number) => grid.map((row) => row[column] as Place);
    this.addSheet(front);
    this.addSheet([...back].reverse());
    const last = (front[0]?.length ?? 0) - 1;
    this.addSheet([back[0] ?? [], front[0] ?? []]);
    this.addSheet([front.at(-1) ?? [], back.at(-1) ?? []]);
    this.addSheet([across(front, 0), across(back, 0)]);
    this.addSheet([across(back, last), across(front, last)]);
  }

  geometry(): BufferGeometry {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(this.corners), 3));
    return toCreasedNormals(geometry, creaseRad);
  }

  private addSheet(grid: Grid): void {
    for (let i = 1; i < grid.length; ++i)
      for (let j = 1; j < (grid[i]?.length ?? 0); ++j) {
        const at = (row: number, column: number) => grid[row]?.[column] as Place;
        this.addFour(at(i - 1, j - 1), at(i, j - 1), at(i, j), at(i - 1, j));
      }
  }

  private addFour(a: Place, b: Place, c: Place, d: Place): void {
    for (const [p, q, r] of [
      [a, b, c],
      [a, c, d],
    ] as const)
      if (!same(p, q) && !same(q, r) && !same(r, p)) this.corners.push(...p, ...q, ...r);
  }
}

const same = (a: Place, b: Place): boolean => a.every((value, i) => Math.abs(value - (b[i] ?? 0)) < 1e-7);
