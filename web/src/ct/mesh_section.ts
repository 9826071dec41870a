import { Vector3 } from 'three';

/** A mesh of triangles, three numbers a vertex. */
export interface SectionedMesh {
  positionsMm: Float32Array;
  indices: Uint32Array;
}

/**
 * Where a plane cuts a mesh: ends of line pieces, each two points of three numbers, in the mesh's frame. The plane holds
 * `through` and is square to `normal` (unit), both in that frame.
 */
export function meshSection({ positionsMm, indices }: SectionedMesh, normal: Vector3, through: Vector3): number[] {
  const offset = normal.dot(through);
  const side = (vertex: number) =>
    (positionsMm[vertex * 3] ?? 0) * normal.x +
    (positionsMm[vertex * 3 + 1] ?? 0) * normal.y +
    (positionsMm[vertex * 3 + 2] ?? 0) * normal.z -
    offset;
  const pieces: number[] = [];
  for (let i = 0; i + 2 < indices.length; i += 3) {
    const corners = [indices[i] ?? 0, indices[i + 1] ?? 0, indices[i + 2] ?? 0] as const;
    const sides = [side(corners[0]), side(corners[1]), side(corners[2])] as const;
    const ends: number[] = [];
    for (const [a, b] of edges) {
      if (sides[a] >= 0 === sides[b] >= 0) continue;
      const share = sides[a] / (sides[a] - sides[b]);
      for (const along of [0, 1, 2]) {
        const from = positionsMm[corners[a] * 3 + along] ?? 0;
        ends.push(from + ((positionsMm[corners[b] * 3 + along] ?? 0) - from) * share);
      }
    }
    if (ends.length === 6) pieces.push(...ends);
  }
  return pieces;
}

const edges = [
  [0, 1],
  [1, 2],
  [2, 0],
] as const;
