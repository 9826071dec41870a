// What is known of the bone at a corner of its surface, in one number for the graphics card:
// (density * (mostGone + 1) + gone) * goneStep + kind + 1. kind: 0 cancellous, 1 cortical, 2 cartilage, -1 unknown. gone: how
// far it lies under the surface that the session began with, 0 not at all to mostGone, half a voxel or more. density: in
// steps of densityStepGCc, 0 where it is not told; it is where something of the block is gone.

export const goneStep = 4;
export const mostGone = 15;
export const densityStepGCc = 0.125;
const unknownKind = -1;

/** Puts the marks of a block into the fourth of each corner's numbers; `classes` and the next as MeshBlock has them. */
export function putBoneMarks(
  normals: Int16Array,
  vertexCount: number,
  classes: Uint8Array | null,
  removed: Uint8Array | null,
  densities: Uint8Array | null,
): void {
  const kinds = longEnough(classes, vertexCount / 4);
  const levels = longEnough(removed, vertexCount / 2);
  const dense = longEnough(densities, vertexCount / 2);
  for (let i = 0; i < vertexCount; ++i) {
    const kind = kinds === null ? unknownKind : ((kinds[i >> 2] ?? 0) >> (2 * (i & 3))) & 3;
    const gone = fourBits(levels, i);
    normals[4 * i + 3] = (fourBits(dense, i) * (mostGone + 1) + gone) * goneStep + kind + 1;
  }
}

const fourBits = (packed: Uint8Array | null, i: number) => ((packed?.[i >> 1] ?? 0) >> (4 * (i & 1))) & 15;

const longEnough = (packed: Uint8Array | null, bytes: number) =>
  packed !== null && packed.length >= Math.ceil(bytes) ? packed : null;
