import type { CaseCt, Triple } from '../wire/rest_types';
import type { VoxelAxis } from '../wire/case_api';

export const voxelAxes: readonly VoxelAxis[] = ['u', 'v', 'w'];
const axisNumber: Record<VoxelAxis, 0 | 1 | 2> = { u: 0, v: 1, w: 2 };

export const dot = (a: Triple, b: Triple): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const add = (a: Triple, b: Triple, scale = 1): Triple => [
  a[0] + b[0] * scale,
  a[1] + b[1] * scale,
  a[2] + b[2] * scale,
];
export const subtract = (a: Triple, b: Triple): Triple => add(a, b, -1);
export const length = (a: Triple): number => Math.hypot(...a);
export const numberOf = (axis: VoxelAxis): 0 | 1 | 2 => axisNumber[axis];

/**
 * Where the CT's voxels are in the world. A place in voxels counts from the volume's corner: voxel (i, j, k) fills
 * i to i + 1 and so on, its middle is at i + 0.5.
 */
export class VolumeFrame {
  readonly dims: Triple;
  readonly spacingMm: Triple;
  /** Unit directions of u, v and w, world frame. */
  readonly directions: readonly [Triple, Triple, Triple];
  private readonly origin: Triple;

  constructor(ct: Pick<CaseCt, 'dims' | 'spacing_mm' | 'world_from_volume'>) {
    const { rotation: r, translation_mm } = ct.world_from_volume;
    this.dims = ct.dims;
    this.spacingMm = ct.spacing_mm;
    this.directions = [
      [r[0][0], r[1][0], r[2][0]],
      [r[0][1], r[1][1], r[2][1]],
      [r[0][2], r[1][2], r[2][2]],
    ];
    this.origin = translation_mm;
  }

  worldFromVoxel(place: Triple): Triple {
    let world = this.origin;
    for (const i of [0, 1, 2] as const) world = add(world, this.directions[i], place[i] * this.spacingMm[i]);
    return world;
  }

  voxelFromWorld(point: Triple): Triple {
    const from = subtract(point, this.origin);
    const along = (i: 0 | 1 | 2) => dot(from, this.directions[i]) / this.spacingMm[i];
    return [along(0), along(1), along(2)];
  }

  /** The nearest place within the middles of the outermost voxels. */
  clampVoxel(place: Triple): Triple {
    const within = (i: 0 | 1 | 2) => Math.min(Math.max(place[i], 0.5), this.dims[i] - 0.5);
    return [within(0), within(1), within(2)];
  }

  /** The slice across an axis in which a place lies. */
  sliceAt(axis: VoxelAxis, place: Triple): number {
    const i = numberOf(axis);
    return Math.min(Math.max(Math.floor(place[i]), 0), this.dims[i] - 1);
  }

  /** Voxels around a box of the world, within the CT. */
  voxelBox(lowMm: Triple, highMm: Triple, marginMm: number): { low: Triple; high: Triple } {
    const low: Triple = [...this.dims];
    const high: Triple = [0, 0, 0];
    for (let corner = 0; corner < 8; ++corner) {
      const at = [0, 1, 2].map((i) => ((corner >> i) & 1 ? (highMm[i] ?? 0) + marginMm : (lowMm[i] ?? 0) - marginMm));
      const voxel = this.voxelFromWorld(at as Triple);
      for (const i of [0, 1, 2] as const) {
        low[i] = Math.max(Math.min(low[i], voxel[i]), 0);
        high[i] = Math.min(Math.max(high[i], voxel[i]), this.dims[i]);
      }
    }
    return { low, high };
  }

  middle(): Triple {
    return [this.dims[0] / 2, this.dims[1] / 2, this.dims[2] / 2];
  }

  /** Corners of the slice at a place, around the edge of what of it lies in a box of voxels; world frame. */
  sliceCorners(axis: VoxelAxis, place: Triple, low: Triple, high: Triple): Triple[] {
    const [a, b] = voxelAxes.filter((other) => other !== axis).map(numberOf) as [0 | 1 | 2, 0 | 1 | 2];
    const ends = [
      [low[a], low[b]],
      [high[a], low[b]],
      [high[a], high[b]],
      [low[a], high[b]],
    ] as const;
    return ends.map(([atA, atB]) => {
      const corner: Triple = [...place];
      corner[a] = atA;
      corner[b] = atB;
      return this.worldFromVoxel(corner);
    });
  }
}
