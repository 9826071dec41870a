import { BufferAttribute, BufferGeometry, Group, Mesh, type Plane } from 'three';

import type { Surface } from '../wire/ply';
import { boneMaterial, lookOfBone } from './bone_material';

/** What of the scapula lies around the bone that is reamed; it never changes, and nothing is picked on it. */
export class SurroundingsView {
  readonly group = new Group();
  private readonly material = boneMaterial();
  private mesh: Mesh | null = null;

  /** Frame of the bone at rest, mm; null: nothing. */
  show(surface: Surface | null): void {
    if (this.mesh !== null) {
      this.mesh.removeFromParent();
      this.mesh.geometry.dispose();
      this.mesh = null;
    }
    if (surface === null) return;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(surface.positions, 3));
    geometry.setAttribute('normal', new BufferAttribute(surface.normals, 3));
    geometry.setIndex(new BufferAttribute(surface.indices, 1));
    this.mesh = new Mesh(geometry, this.material);
    this.group.add(this.mesh);
  }

  /** What lies on the negative side of any plane (world frame) is left out. */
  cut(planes: Plane[]): void {
    lookOfBone(this.material, 1, planes);
  }

  dispose(): void {
    this.show(null);
    this.material.dispose();
  }
}
