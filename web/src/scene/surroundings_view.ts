import { Box3, Group, Mesh, type Plane, Vector3 } from 'three';

import { PlanFrame } from '../practice/plan_frame';
import type { Hello } from '../wire/messages';
import type { Surface } from '../wire/ply';
import { boneMaterial, lookOfBone } from './bone_material';
import { shadowed } from './lights';
import { surfaceGeometry } from './surface_geometry';
import { poseMatrix } from './pose_matrix';

/**
 * What a reamer on the planned axis may come to is described by the streamed bone alone: as wide as this about the axis and
 * as deep under the entry, mm; server/ct/build/surroundings.cpp has them, too.
 */
const reamersReachMm = 24;
const reamersDepthMm = 12;

/** What of the scapula lies around the bone that is reamed; it never changes, and nothing is picked on it. */
export class SurroundingsView {
  readonly group = new Group();
  readonly material = boneMaterial();
  private mesh: Mesh | null = null;
  private surface: Surface | null = null;
  private hello: Hello | null = null;

  /** Frame of the bone at rest, mm; null: nothing. */
  show(surface: Surface | null): void {
    this.surface = surface;
    this.draw();
  }

  begin(hello: Hello): void {
    this.hello = hello;
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
    const { surface, hello } = this;
    if (this.mesh !== null) {
      this.mesh.removeFromParent();
      this.mesh.geometry.dispose();
      this.mesh = null;
    }
    if (surface === null || hello === null) return;
    this.mesh = shadowed(new Mesh(surfaceGeometry(surface, beyondReach(surface, hello)), this.material));
    this.group.add(this.mesh);
  }
}

type GridAndPlan = Pick<Hello, 'axisEntryMm' | 'axisDirection' | 'gridDims' | 'voxelSpacingMm' | 'worldFromGrid'>;

/** Triangles that do not lie with all corners in the streamed bone's box where a reamer on the planned axis may come. */
export function beyondReach({ positions, indices }: Surface, of: GridAndPlan): Uint32Array<ArrayBuffer> {
  const { entry, axis } = new PlanFrame(of);
  const gridFromWorld = poseMatrix(of.worldFromGrid).invert();
  const box = new Box3(new Vector3(), new Vector3(...of.gridDims).multiply(new Vector3(...of.voxelSpacingMm)));
  const [at, from] = [new Vector3(), new Vector3()];
  const inReach = new Uint8Array(positions.length / 3);
  for (let i = 0; i < inReach.length; ++i) {
    from.fromArray(positions, 3 * i);
    const inBox = box.containsPoint(at.copy(from).applyMatrix4(gridFromWorld));
    const alongMm = from.sub(entry).dot(axis);
    const besideMm = from.addScaledVector(axis, -alongMm).length();
    inReach[i] = inBox && alongMm < reamersDepthMm && besideMm < reamersReachMm ? 1 : 0;
  }
  const left: number[] = [];
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [indices[i] ?? 0, indices[i + 1] ?? 0, indices[i + 2] ?? 0];
    if (!(inReach[a] && inReach[b] && inReach[c])) left.push(a, b, c);
  }
  return Uint32Array.from(left);
}
