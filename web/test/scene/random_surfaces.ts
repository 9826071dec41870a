import { MeshBasicMaterial, Vector3 } from 'three';

import { BonePicture } from '../../src/scene/bone_picture';
import type { BlockSurface, Hello } from '../../src/wire/messages';
import { hello } from '../wire/fake_messages';

const gridDims = [300, 200, 170] as const;
const edge = 32;
export const blockCount = 10 * 7 * 6;
const spacing = new Vector3(0.5, 0.25, 0.75);

export function pictured(): BonePicture {
  const message = hello({ gridDims, blockEdgeVoxels: edge, voxelSpacingMm: spacing.toArray() });
  if (message.kind !== 'hello') throw new Error('not a hello');
  return new BonePicture(message.hello satisfies Hello, new MeshBasicMaterial());
}

/** Numbers from 0 to 1 that are the same for the same seed. */
export function randomNumbers(seed: number): () => number {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

export function randomSurface(random: () => number, block: number, revision: number): BlockSurface {
  const triangles = Math.floor(random() * 5);
  const corners = 3 * triangles;
  const among = (count: number) => Math.floor(random() * count);
  return {
    block,
    revision,
    tick: 0,
    positions: Uint16Array.from({ length: 4 * corners }, (_, i) => (i % 4 === 3 ? 0 : among(34 * 1024))),
    normals: Int16Array.from({ length: 4 * corners }, (_, i) => (i % 4 === 3 ? among(64) : among(65535) - 32767)),
    indices: Uint16Array.from({ length: corners }, (_, i) => i),
  };
}

/** With at least one triangle. */
export function fullSurface(random: () => number, block: number, revision: number): BlockSurface {
  for (;;) {
    const surface = randomSurface(random, block, revision);
    if (surface.indices.length > 0) return surface;
  }
}

/** Where a corner of a block lies in the grid, mm. Blocks begin one voxel before their own; x runs fastest. */
export function placeOf(block: number, positions: Uint16Array, corner: number): Vector3 {
  const origin = new Vector3(block % 10, Math.floor(block / 10) % 7, Math.floor(block / 70));
  return new Vector3()
    .fromArray(positions, 4 * corner)
    .divideScalar(1024)
    .addScaledVector(origin, edge)
    .subScalar(1)
    .multiply(spacing);
}
