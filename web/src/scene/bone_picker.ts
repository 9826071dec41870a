import {
  DoubleSide,
  FrontSide,
  Matrix4,
  Mesh,
  type BufferGeometry,
  type Object3D,
  type Plane,
  Ray,
  Vector3,
} from 'three';

import type { Ray as LineOfSight } from '../practice/plan_frame';
import type { Triple } from '../wire/messages';
import { hitsOf } from './line_hits';

/** A place of the bone that is seen. */
export interface BonePick {
  /** In the frame of the bone at rest, which is the CT's; mm. */
  place: Triple;
  /** Of the surface's corners the nearest, by its number in the mesh that was met. */
  corner: number;
  mesh: Mesh;
}

/**
 * Where a line of sight first meets what is seen of the bone; null: nowhere. `group` is the bone's, with everything in it;
 * what lies on the negative side of any of `cuts` (world frame) is not seen.
 */
export function pickBone(group: Object3D, sight: LineOfSight, cuts: readonly Plane[]): BonePick | null {
  group.updateMatrixWorld();
  const ray = new Ray(sight.origin, sight.direction);
  // Where bone is cut away, one looks at the inside of its surface, too.
  const side = cuts.length > 0 ? DoubleSide : FrontSide;
  let nearest: { distance: number; at: Vector3; corner: number; mesh: Mesh } | null = null;
  group.traverseVisible((object) => {
    if (!(object instanceof Mesh)) return;
    const mesh = object as Mesh;
    const local = ray.clone().applyMatrix4(new Matrix4().copy(mesh.matrixWorld).invert());
    const { boundingSphere } = mesh.geometry;
    if (boundingSphere !== null && !local.intersectsSphere(boundingSphere)) return;
    for (const hit of hitsOf(mesh.geometry, local, side)) {
      const at = hit.point.clone().applyMatrix4(mesh.matrixWorld);
      const distance = at.distanceTo(sight.origin);
      if (nearest !== null && nearest.distance <= distance) continue;
      if (cuts.some((cut) => cut.distanceToPoint(at) < 0)) continue;
      nearest = { distance, at, corner: nearestCorner(mesh.geometry, hit.corners, hit.point), mesh };
    }
  });
  if (nearest === null) return null;
  const { at, corner, mesh } = nearest as { at: Vector3; corner: number; mesh: Mesh };
  return { place: group.worldToLocal(at).toArray(), corner, mesh };
}

function nearestCorner(geometry: BufferGeometry, corners: readonly number[], point: Vector3): number {
  const positions = geometry.getAttribute('position');
  const far = corners.map((corner) => new Vector3().fromBufferAttribute(positions, corner).distanceToSquared(point));
  return corners[far.indexOf(Math.min(...far))] ?? 0;
}
