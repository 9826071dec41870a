import {
  BufferAttribute,
  BufferGeometry,
  Group,
  InterleavedBuffer,
  InterleavedBufferAttribute,
  Matrix4,
  Mesh,
  type MeshStandardMaterial,
  type Object3D,
  type Plane,
  Quaternion,
  Sphere,
  Vector3,
} from 'three';

import type { BlockSurface, Hello, MeshDelta, Pose } from '../wire/messages';
import { lookOfBone } from './bone_material';
import { BonePaint, kindAttribute } from './bone_paint';

/** Steps of a block's vertex positions in one voxel. */
const stepsPerVoxel = 1024;

interface ShownBlock {
  mesh: Mesh;
  revision: number;
}

/** One whole picture of the bone: a mesh for each block that has a surface. */
class BonePicture {
  readonly group = new Group();
  private readonly blocks = new Map<number, ShownBlock>();
  private readonly blocksX: number;
  private readonly blocksY: number;

  constructor(
    private readonly hello: Hello,
    private readonly material: MeshStandardMaterial,
  ) {
    const edge = hello.blockEdgeVoxels;
    this.blocksX = Math.ceil(hello.gridDims[0] / edge);
    this.blocksY = Math.ceil(hello.gridDims[1] / edge);
    this.group.matrixAutoUpdate = false;
    this.group.matrix.compose(
      new Vector3(...hello.worldFromGrid.translationMm),
      new Quaternion(...hello.worldFromGrid.rotationXyzw),
      new Vector3(1, 1, 1),
    );
  }

  get blockCount(): number {
    return this.blocks.size;
  }

  /** Replaces a block unless a newer revision of it is shown. */
  apply(surface: BlockSurface): void {
    const shown = this.blocks.get(surface.block);
    if (shown !== undefined && shown.revision > surface.revision) return;
    if (shown !== undefined) {
      this.group.remove(shown.mesh);
      shown.mesh.geometry.dispose();
      this.blocks.delete(surface.block);
    }
    if (surface.indices.length === 0) return;
    const mesh = new Mesh(this.geometry(surface), this.material);
    mesh.matrixAutoUpdate = false;
    mesh.matrix.copy(this.gridFromSteps(surface.block));
    this.group.add(mesh);
    this.blocks.set(surface.block, { mesh, revision: surface.revision });
  }

  dispose(): void {
    this.group.removeFromParent();
    for (const { mesh } of this.blocks.values()) mesh.geometry.dispose();
    this.blocks.clear();
  }

  private geometry(surface: BlockSurface): BufferGeometry {
    const geometry = new BufferGeometry();
    const positions = new InterleavedBuffer(surface.positions, 4);
    const normals = new InterleavedBuffer(surface.normals, 4);
    geometry.setAttribute('position', new InterleavedBufferAttribute(positions, 3, 0));
    geometry.setAttribute('normal', new InterleavedBufferAttribute(normals, 3, 0, true));
    geometry.setAttribute(kindAttribute, new InterleavedBufferAttribute(normals, 1, 3));
    geometry.setIndex(new BufferAttribute(surface.indices, 1));
    const halfEdge = ((this.hello.blockEdgeVoxels + 2) / 2) * stepsPerVoxel;
    geometry.boundingSphere = new Sphere(new Vector3(halfEdge, halfEdge, halfEdge), halfEdge * Math.sqrt(3));
    return geometry;
  }

  /** mm in the grid frame from a block's vertex steps, which begin one voxel before the block. */
  private gridFromSteps(block: number): Matrix4 {
    const edge = this.hello.blockEdgeVoxels;
    const x = block % this.blocksX;
    const y = Math.floor(block / this.blocksX) % this.blocksY;
    const z = Math.floor(block / (this.blocksX * this.blocksY));
    const spacing = new Vector3(...this.hello.voxelSpacingMm);
    const origin = new Vector3(x, y, z).multiplyScalar(edge).addScalar(-1).multiply(spacing);
    return new Matrix4().compose(origin, new Quaternion(), spacing.divideScalar(stepsPerVoxel));
  }
}

/** What is seen in place of the streamed bone, in the frame of the bone at rest. */
export interface InsteadOfBone {
  readonly object: Object3D;
  /** As BoneView has it. */
  setLook(opacity: number, cuts: Plane[]): void;
}

/**
 * The bone. A new connection's picture is put together unseen and takes the old one's place when it is whole, so that
 * pictures of two sessions or two moments are never mixed; a first picture is seen as it grows.
 */
export class BoneView {
  readonly group = new Group();
  readonly paint = new BonePaint();
  private shown: BonePicture | null = null;
  private incoming: BonePicture | null = null;
  private instead: InsteadOfBone | null = null;

  begin(hello: Hello): void {
    this.incoming?.dispose();
    const picture = new BonePicture(hello, this.paint.material);
    if (this.shown === null || this.shown.blockCount === 0) {
      this.show(picture);
    } else {
      this.incoming = picture;
    }
  }

  /** How far the bone has moved from where the hello has it; null: not at all. */
  setPose(worldFromBoneRest: Pose | null): void {
    this.group.position.set(...(worldFromBoneRest?.translationMm ?? [0, 0, 0]));
    this.group.quaternion.set(...(worldFromBoneRest?.rotationXyzw ?? [0, 0, 0, 1]));
  }

  /** How much of it is seen: opacity 0 to 1; what lies on the negative side of any plane (world frame) is left out. */
  setLook(opacity: number, cuts: Plane[]): void {
    lookOfBone(this.paint.material, opacity, cuts);
    this.instead?.setLook(opacity, cuts);
  }

  /** Shows something else in the bone's place; null: the bone again. */
  showInstead(other: InsteadOfBone | null): void {
    this.instead?.object.removeFromParent();
    this.instead = other;
    if (other !== null) this.group.add(other.object);
    if (this.shown !== null) this.shown.group.visible = other === null;
  }

  dispose(): void {
    this.showInstead(null);
    this.shown?.dispose();
    this.incoming?.dispose();
    this.paint.dispose();
  }

  apply(mesh: MeshDelta): void {
    const picture = this.incoming ?? this.shown;
    if (picture === null) return;
    for (const block of mesh.blocks) picture.apply(block);
    if (mesh.keyComplete && this.incoming !== null) this.show(this.incoming);
  }

  get blockCount(): number {
    return this.shown?.blockCount ?? 0;
  }

  private show(picture: BonePicture): void {
    this.shown?.dispose();
    this.shown = picture;
    this.incoming = null;
    picture.group.visible = this.instead === null;
    this.group.add(picture.group);
  }
}
