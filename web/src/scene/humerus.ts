import { type BufferGeometry, Color, Vector3 } from 'three';

import { RingSurface } from './ring_surface';
import type { FieldPoint } from './wound_shape';

const headRadiusMm = 24;
/** Of the cut surface: its middle, where it looks, and two directions in it, the second one away from the glenoid. */
export const humerusCut = cutFrame([-3, -36, 19], new Vector3(0.12, 0.76, 0.64).normalize());
const cutRadiusMm = 20;
const around = 72;
const grains = 20;

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
  const surface = new RingSurface(around);
  const { centre, towards, across, other } = humerusCut;
  const addRing = (radiusMm: number, underCutMm: number, colour: Color, grainOf: (i: number) => number) =>
    surface.add((angle, i) => {
      const at = new Vector3(...centre)
        .addScaledVector(across, radiusMm * Math.cos(angle))
        .addScaledVector(other, 0.92 * radiusMm * Math.sin(angle))
        .addScaledVector(towards, -underCutMm);
      return { at: at.toArray(), colour, light: 0.8 * grainOf(i) };
    });
  for (let ring = 0; ring < grains; ++ring)
    addRing(
      (0.92 * cutRadiusMm * ring) / (grains - 1),
      0,
      cancellous,
      // Spongy bone is not of one colour.
      (i) => 0.8 + 0.35 * scattered(i + around * ring),
    );
  for (const [radiusMm, underCutMm] of [
    [0.93 * cutRadiusMm, 0],
    [cutRadiusMm, 0.4],
    [headRadiusMm, 6],
    [20, 20],
  ] as const)
    addRing(radiusMm, underCutMm, cortical, () => 1);
  return surface.geometry();
}
