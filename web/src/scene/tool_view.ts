import { BufferAttribute, BufferGeometry, CylinderGeometry, Group, Mesh, MeshStandardMaterial, Vector3 } from 'three';
import { toCreasedNormals } from 'three/examples/jsm/utils/BufferGeometryUtils.js';

import type { Pose, ToolMesh } from '../wire/messages';

const creaseRad = 0.6;
const envelopeOpacity = 0.5;
const glassColour = 0x8fb3c4;
const steelColour = 0xb4c0c6;
const shaftRadiusMm = 3;
const shaftLengthMm = 45;

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
    opacity: envelopeOpacity,
  });
  private readonly shaftMaterial = new MeshStandardMaterial({ color: 0xd3dade, roughness: 0.45, metalness: 0.1 });
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
    const envelope = toCreasedNormals(indexed, creaseRad);
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

  /** Opaque where the bone is seen through, and in theatre. */
  setOpaque(opaque: boolean): void {
    if (this.envelopeMaterial.transparent === !opaque) return;
    this.envelopeMaterial.transparent = !opaque;
    this.envelopeMaterial.opacity = opaque ? 1 : envelopeOpacity;
    this.envelopeMaterial.color.set(opaque ? steelColour : glassColour);
    this.envelopeMaterial.needsUpdate = true;
  }

  setShown(shown: boolean): void {
    this.wanted = shown;
    this.refresh();
  }

  private refresh(): void {
    this.group.visible = this.posed && this.wanted;
  }
}
