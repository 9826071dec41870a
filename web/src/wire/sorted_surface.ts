import { BufferAttribute, BufferGeometry } from 'three';
import { MeshBVH } from 'three-mesh-bvh';

import type { Surface } from './ply';

/** A surface and the tree of boxes around its triangles. */
export interface SortedSurface extends Surface {
  boxes: ArrayBuffer[];
}

/** Sorts its triangles for picking; `buffers` can change threads. */
export function sortedSurface(surface: Surface): { surface: SortedSurface; buffers: ArrayBuffer[] } {
  const { positions, normals, indices } = surface;
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(indices, 1));
  // Triangles are put into another order, their corners are not.
  const { roots } = MeshBVH.serialize(new MeshBVH(geometry), { cloneBuffers: false });
  return {
    surface: { ...surface, boxes: roots },
    buffers: [positions.buffer, normals.buffer, indices.buffer, ...roots],
  };
}
