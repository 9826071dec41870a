import { BufferAttribute, BufferGeometry, Color, Vector3 } from 'three';

import type { FieldPoint } from './wound_shape';

const headRadiusMm = 24;
/** Of the cut surface: its middle, where it looks, and two directions in it, the second one away from the glenoid. */
export const humerusCut = cutFrame([-3, -36, 19], new Vector3(0.12, 0.76, 0.64).normalize());
const cutRadiusMm = 20;

function cutFrame(centre: FieldPoint, towards: Vector3) {
  const across = new Vector3(-1, 0, 0).addScaledVector(towards, towards.x).normalize();
  const other = new Vector3().crossVectors(towards, across);
  return { centre, towards, across, other };
}

const cancellous = new Color(0xc98a6a);
const cortical = new Color(0xe8d8ba);

/** Of no pattern, and always the same; 0 to 1. */
function scattered(i: number): number {
  const mixed = Math.imul(i ^ (i >>> 3), 0x9e3779b1);
  return (Math.imul(mixed ^ (mixed >>> 15), 0x85ebca6b) >>> 8) / 2 ** 24;
}

/** The humerus after its head was cut off: a spongy surface within a rim of compact bone, and what is under it. */
export function humerusGeometry(): BufferGeometry {
  const positions: number[] = [];
  const colours: number[] = [];
  const indices: number[] = [];
  const around = 72;
  const grains = 20;
  const { centre, towards, across, other } = humerusCut;
  const rings: [radius: number, depth: number, colour: Color][] = Array.from({ length: grains }, (_, i) => [
    (0.92 * cutRadiusMm * i) / (grains - 1),
    0,
    cancellous,
  ]);
  rings.push([0.93 * cutRadiusMm, 0, cortical], [cutRadiusMm, 0.4, cortical]);
  rings.push([headRadiusMm, 6, cortical], [20, 20, cortical]);
  rings.forEach(([radius, depth, colour], row) => {
    for (let i = 0; i < around; ++i) {
      const angle = (2 * Math.PI * i) / around;
      // Spongy bone is not of one colour.
      const grain = colour === cancellous ? 0.8 + 0.35 * scattered(i + around * row) : 1;
      const at = new Vector3(...centre)
        .addScaledVector(across, radius * Math.cos(angle))
        .addScaledVector(other, 0.92 * radius * Math.sin(angle))
        .addScaledVector(towards, -depth);
      positions.push(at.x, at.y, at.z);
      colours.push(...[colour.r, colour.g, colour.b].map((value) => 0.8 * grain * value));
      if (row === 0) continue;
      const [next, below] = [(i + 1) % around, (row - 1) * around];
      indices.push(below + i, row * around + i, row * around + next, below + i, row * around + next, below + next);
    }
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute('color', new BufferAttribute(new Float32Array(colours), 3));
  geometry.setIndex(indices);
  geometry.computeVertexNormals();
  return geometry;
}
