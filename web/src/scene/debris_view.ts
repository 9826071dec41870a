import { Color, IcosahedronGeometry, InstancedMesh, Matrix4, MeshStandardMaterial, Quaternion, Vector3 } from 'three';

import { chipsMost, type Debris, dropsMost, type Particle } from './debris';

const dryBone = new Color(0xf6e6cf);
const bloodyBone = new Color(0xa8604c);
/** Brighter than white under a lamp, as what glitters. */
const water = new Color(1.7, 1.9, 2.1);
/** Chips are curled flakes; drops are drawn out along their way. */
const chipShape = new Vector3(1, 0.65, 0.3);
const dropShape = new Vector3(0.5, 0.5, 2.6);
/** From this share of its life on a particle grows less. */
const fadesFrom = 0.55;
const ahead = new Vector3(0, 0, 1);

/** All of the debris, in one drawing. */
export class DebrisView {
  readonly mesh: InstancedMesh;
  private readonly matrix = new Matrix4();
  private readonly colour = new Color();

  constructor() {
    const material = new MeshStandardMaterial({ roughness: 0.25, metalness: 0, transparent: true, opacity: 0.82 });
    this.mesh = new InstancedMesh(new IcosahedronGeometry(1, 0), material, chipsMost + dropsMost);
    this.mesh.frustumCulled = false;
    this.mesh.count = 0;
    this.mesh.visible = false;
    this.mesh.renderOrder = 1;
  }

  show({ particles }: Debris, seen: boolean): void {
    const { mesh } = this;
    mesh.visible = seen && particles.length > 0;
    if (!mesh.visible) return;
    mesh.count = particles.length;
    particles.forEach((particle, i) => {
      mesh.setMatrixAt(i, this.placed(particle));
      mesh.setColorAt(i, this.coloured(particle));
    });
    mesh.instanceMatrix.needsUpdate = true;
    if (mesh.instanceColor !== null) mesh.instanceColor.needsUpdate = true;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    (this.mesh.material as MeshStandardMaterial).dispose();
    this.mesh.dispose();
  }

  private placed({ kind, at, velocity, turn, sizeMm, ageS, lifeS }: Particle): Matrix4 {
    const left = Math.min((1 - ageS / lifeS) / (1 - fadesFrom), 1);
    const scale = (kind === 'chip' ? chipShape : dropShape).clone().multiplyScalar(sizeMm * left);
    const along = kind === 'chip' ? turn : new Quaternion().setFromUnitVectors(ahead, velocity.clone().normalize());
    return this.matrix.compose(at, along, scale);
  }

  private coloured({ kind, shade }: Particle): Color {
    return kind === 'drop' ? this.colour.copy(water) : this.colour.lerpColors(dryBone, bloodyBone, shade * shade);
  }
}
