import { Group, Mesh, type Plane, Vector3 } from 'three';

import type { PlanFrame } from '../practice/plan_frame';
import type { Surface } from '../wire/ply';
import { boneMaterial, lookOfBone } from './bone_material';
import { surfaceGeometry } from './surface_geometry';

/**
 * What a reamer on the planned axis may come to is described by the streamed bone alone: as wide as this about the axis and
 * as deep under the entry, mm; server/ct/build/surroundings.cpp has them, too.
 */
const reamersReachMm = 24;
const reamersDepthMm = 12;

/** What of the scapula lies around the bone that is reamed; it never changes, and nothing is picked on it. */
export class SurroundingsView {
  readonly group = new Group();
  private readonly material = boneMaterial();
  private mesh: Mesh | null = null;
  private surface: Surface | null = null;
  private plan: PlanFrame | null = null;

  /** Frame of the bone at rest, mm; null: nothing. */
  show(surface: Surface | null): void {
    this.surface = surface;
    this.draw();
  }

  setPlan(plan: PlanFrame): void {
    this.plan = plan;
    this.draw();
  }

  /** What lies on the negative side of any plane (world frame) is left out; all is while the bone is seen through. */
  setLook(seenThrough: boolean, cuts: Plane[]): void {
    this.group.visible = !seenThrough;
    lookOfBone(this.material, 1, cuts);
  }

  dispose(): void {
    this.show(null);
    this.material.dispose();
  }

  private draw(): void {
    const { surface, plan } = this;
    if (this.mesh !== null) {
      this.mesh.removeFromParent();
      this.mesh.geometry.dispose();
      this.mesh = null;
    }
    if (surface === null || plan === null) return;
    this.mesh = new Mesh(surfaceGeometry(surface, beyondReach(surface, plan.entry, plan.axis)), this.material);
    this.group.add(this.mesh);
  }
}

/** Triangles that do not lie with all corners where a reamer on that axis may come. */
export function beyondReach({ positions, indices }: Surface, entry: Vector3, axis: Vector3): Uint32Array<ArrayBuffer> {
  const from = new Vector3();
  const inReach = new Uint8Array(positions.length / 3);
  for (let i = 0; i < inReach.length; ++i) {
    from.fromArray(positions, 3 * i).sub(entry);
    const alongMm = from.dot(axis);
    inReach[i] = alongMm < reamersDepthMm && from.addScaledVector(axis, -alongMm).length() < reamersReachMm ? 1 : 0;
  }
  const left: number[] = [];
  for (let i = 0; i < indices.length; i += 3) {
    const [a = 0, b = 0, c = 0] = indices.subarray(i, i + 3);
    if (!(inReach[a] && inReach[b] && inReach[c])) left.push(a, b, c);
  }
  return Uint32Array.from(left);
}
