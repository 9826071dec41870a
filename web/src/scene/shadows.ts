import type { Mesh } from 'three';

/** Throws shadows and is in those of others, wherever the light throws any. */
export function shadowed<T extends Mesh>(mesh: T): T {
  mesh.castShadow = true;
  mesh.receiveShadow = true;
  return mesh;
}
