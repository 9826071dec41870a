import { VolumeFrame } from '../../src/ct/volume_frame';
import type { Triple } from '../../src/wire/rest_types';

type Rows = [Triple, Triple, Triple];

/** Turns by radians about x, then y, then z. */
export function turned(x: number, y: number, z: number): Rows {
  const about = (axis: number, angle: number): Rows => {
    const rows: Rows = [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ];
    const [a, b] = [(axis + 1) % 3, (axis + 2) % 3] as [0, 1];
    rows[a][a] = rows[b][b] = Math.cos(angle);
    rows[a][b] = -Math.sin(angle);
    rows[b][a] = Math.sin(angle);
    return rows;
  };
  const times = (p: Rows, q: Rows): Rows =>
    p.map((row) => [0, 1, 2].map((j) => row.reduce((sum, value, k) => sum + value * (q[k]?.[j] ?? 0), 0))) as Rows;
  return times(about(2, z), times(about(1, y), about(0, x)));
}

export function frameOf(
  rotation: Rows,
  dims: Triple = [40, 50, 60],
  spacing_mm: Triple = [0.5, 0.75, 2],
  translation_mm: Triple = [-12, 34, -56],
): VolumeFrame {
  return new VolumeFrame({ dims, spacing_mm, world_from_volume: { rotation, translation_mm } });
}

export const straight: Rows = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];

/** Numbers in [0, 1) that are the same in every run. */
export function random(seed: number): () => number {
  let state = seed;
  return () => (state = (state * 48271) % 0x7fffffff) / 0x7fffffff;
}
