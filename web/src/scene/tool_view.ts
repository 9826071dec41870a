import { BufferAttribute, BufferGeometry, CylinderGeometry, Group, Mesh, MeshStandardMaterial, Vector3 } from 'three';
import { mergeVertices, toCreasedNormals } from 'three/examples/jsm/utils/BufferGeometryUtils.js';

import type { Pose, ToolMesh } from '../wire/messages';

const creaseRad = 0.6;
const glassColour = 0x8fb3c4;
const steelColour = 0xb4c0c6;
const shaftRadiusMm = 3;
const shaftLengthMm = 45;

export type ToolLook = 'glass' | 'throughBone' | 'steel';

/**
 * The reamer where the server says it is: the cutting envelope, see-through so that the bone under it can be judged,
 * and a shaft, which is not part of the model and only shows the axis.
 */
export class ToolView {
  readonly group = new Group();
  private readonly envelopeMaterial = new MeshStandardMaterial({
    color: glassColour,
    roughness: 0.28,
    metalness: 0.1,
    transparent: true,
    opacity: 0.5,
  });
  private readonly shaftMaterial = new MeshStandardMaterial({ color: 0xd3dade, roughness: 0.45, metalness: 0.1 });
  private look: ToolLook = 'glass';
  private posed = false;
  private wanted = true;

  setMesh(tool: ToolMesh): void {
    for (const part of [...this.group.children]) {
      this.group.remove(part);
      (part as Mesh).geometry.dispose();
    }
    this.posed = false;
    this.refresh();
    if (tool.indices.length === 0) return;
    const indexed = new BufferGeometry();
    indexed.setAttribute('position', new BufferAttribute(tool.positionsMm, 3));
    indexed.setIndex(new BufferAttribute(tool.indices, 1));
    const envelope = mergeVertices(toCreasedNormals(indexed, creaseRad));
    envelope.computeBoundingBox();
    this.group.add(new Mesh(envelope, this.envelopeMaterial));
    const top = envelope.boundingBox?.min.z ?? 0;
    const shaft = new CylinderGeometry(shaftRadiusMm, shaftRadiusMm, shaftLengthMm, 40);
    shaft.rotateX(Math.PI / 2).translate(0, 0, top - shaftLengthMm / 2);
    this.group.add(new Mesh(shaft, this.shaftMaterial));
  }

  /** Not drawn until its first pose is known. */
  setPose(pose: Pose | null): void {
    this.posed = pose !== null;
    if (pose !== null) {
      this.group.position.copy(new Vector3(...pose.translationMm));
      this.group.quaternion.set(...pose.rotationXyzw);
    }
    this.refresh();
  }

  /**
   * Glass, so that the bone under it can be judged; steel in theatre. With bone that is seen through it is drawn first and
   * hides nothing, so that both are seen through each other.
   */
  setLook(look: ToolLook): void {
    if (look === this.look) return;
    this.look = look;
    const { envelopeMaterial } = this;
    envelopeMaterial.transparent = look !== 'steel';
    envelopeMaterial.opacity = { glass: 0.5, throughBone: 0.8, steel: 1 }[look];
    envelopeMaterial.depthWrite = look !== 'throughBone';
    envelopeMaterial.color.set(look === 'steel' ? steelColour : glassColour);
    envelopeMaterial.needsUpdate = true;
  }

  setShown(shown: boolean): void {
    this.wanted = shown;
    this.refresh();
  }

  private refresh(): void {
    this.group.visible = this.posed && this.wanted;
  }
}
