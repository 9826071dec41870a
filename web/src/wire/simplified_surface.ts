// A block's surface of fewer triangles, for where drawing costs by the triangle: a picture in software of the whole bone takes
// most of a second, and on the flat of a bone six of seven triangles are not seen.
import { MeshoptSimplifier } from 'meshoptimizer/simplifier';

import { goneStep } from './bone_marks';
import type { BlockSurface } from './messages';
import type { Triple } from './pose';

/** About so far from where it was a simplified surface lies, on average over what a triangle stands for. */
export const simplifiedToMm = 0.02;
/** And not farther than so much of a voxel. */
const simplifiedToVoxels = 0.1;
/** How much it counts that normals turn, beside distances (meshoptimizer's scale, without unit). */
const normalWeight = 0.05;
const stride = 4;
const stepsPerVoxel = 1024;
const normalSteps = 32767;

/** Resolves once surfaces may be simplified. */
export const simplifierReady: Promise<void> = MeshoptSimplifier.ready;

/**
 * Nearly the same surface, of some of its corners. Where a block meets its neighbours nothing moves, and nothing where its marks
 * (bone_marks) change. A block of which bone is gone stays whole, as it soon changes again. Whatever came
 * before, the same surface looks the same.
 */
export function simplifiedSurface(surface: BlockSurface, voxelSpacingMm: Triple): BlockSurface {
  const { positions, normals, indices } = surface;
  if (indices.length === 0 || somethingIsGone(surface)) return surface;
  const [fewer] = MeshoptSimplifier.simplifyWithAttributes(
    Uint32Array.from(indices),
    placesMm(positions, voxelSpacingMm),
    3,
    unitNormals(normals, voxelSpacingMm),
    3,
    [normalWeight, normalWeight, normalWeight],
    whereMarksChange(surface),
    0,
    Math.min(simplifiedToMm, simplifiedToVoxels * Math.min(...voxelSpacingMm)),
    ['LockBorder', 'ErrorAbsolute'],
  );
  return fewer.length < indices.length ? ofCorners(surface, fewer) : surface;
}

const somethingIsGone = ({ normals }: BlockSurface) =>
  normals.some((value, i) => i % stride === 3 && value >= goneStep);

const marksOf = (normals: Int16Array, corner: number) => normals[stride * corner + 3] ?? 0;

function placesMm(positions: Uint16Array, spacingMm: Triple): Float32Array {
  const places = new Float32Array((positions.length / stride) * 3);
  for (let from = 0, to = 0; from < positions.length; from += stride, to += 3)
    for (let axis = 0; axis < 3; ++axis)
      places[to + axis] = ((positions[from + axis] ?? 0) / stepsPerVoxel) * (spacingMm[axis] ?? 1);
  return places;
}

/** As they were before they were stretched (octahedral). */
function unitNormals(normals: Int16Array, spacingMm: Triple): Float32Array {
  const units = new Float32Array((normals.length / stride) * 3);
  const scale = spacingMm.map((mm) => Math.max(...spacingMm) / (normalSteps * mm));
  for (let from = 0, to = 0; from < normals.length; from += stride, to += 3)
    for (let axis = 0; axis < 3; ++axis) units[to + axis] = (normals[from + axis] ?? 0) * (scale[axis] ?? 0);
  return units;
}

/** 1 at the corners of every triangle whose corners are not marked alike. */
function whereMarksChange({ normals, indices, positions }: BlockSurface): Uint8Array {
  const kept = new Uint8Array(positions.length / stride);
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [indices[i] ?? 0, indices[i + 1] ?? 0, indices[i + 2] ?? 0];
    const marks = marksOf(normals, a);
    if (marksOf(normals, b) !== marks || marksOf(normals, c) !== marks) kept[a] = kept[b] = kept[c] = 1;
  }
  return kept;
}

/** The surface of these triangles, without corners that none of them has. */
function ofCorners(surface: BlockSurface, triangles: Uint32Array): BlockSurface {
  const [remap, count] = MeshoptSimplifier.compactMesh(triangles);
  const positions = new Uint16Array(stride * count);
  const normals = new Int16Array(stride * count);
  remap.forEach((to, from) => {
    if (to >= count) return;
    positions.set(surface.positions.subarray(stride * from, stride * (from + 1)), stride * to);
    normals.set(surface.normals.subarray(stride * from, stride * (from + 1)), stride * to);
  });
  const indices = count > 65536 ? Uint32Array.from(triangles) : Uint16Array.from(triangles);
  return { ...surface, positions, normals, indices };
}
