import { BufferAttribute, BufferGeometry } from 'three';

import type { Surface } from '../wire/ply';

/** A surface to be drawn; its corners are shared, not copied. `drawn`: the triangles that are seen, else all. */
export function surfaceGeometry(
  { positions, normals, indices }: Pick<Surface, 'positions' | 'normals' | 'indices'>,
  drawn: Uint32Array<ArrayBuffer> = indices,
): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setAttribute('normal', new BufferAttribute(normals, 3));
  geometry.setIndex(new BufferAttribute(drawn, 1));
  return geometry;
}
