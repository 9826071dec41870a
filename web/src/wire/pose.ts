import type { Pose as WirePose } from './generated/ream/wire/pose';
import type { Vec3 } from './generated/ream/wire/vec3';

export type Triple = readonly [number, number, number];

/** Rigid pose: rotate by the unit quaternion (x, y, z, w), then translate. */
export interface Pose {
  rotationXyzw: readonly [number, number, number, number];
  translationMm: Triple;
}

export function triple(v: Vec3 | null, absent: Triple): Triple {
  return v === null ? absent : [v.x(), v.y(), v.z()];
}

export function pose(p: WirePose | null): Pose | null {
  const q = p?.rotation() ?? null;
  const t = p?.translationMm() ?? null;
  if (q === null || t === null) return null;
  return { rotationXyzw: [q.x(), q.y(), q.z(), q.w()], translationMm: [t.x(), t.y(), t.z()] };
}
