import { Group, type Object3D, type Plane } from 'three';

import type { BlockSurface, Hello, MeshDelta, Pose } from '../wire/messages';
import { lookOfBone } from './bone_material';
import { BonePaint } from './bone_paint';
import { BonePicture } from './bone_picture';

/** Between two regions that are put together, so that no picture waits for more than one. */
const settleEveryMs = 30;
/** While nothing has come to rest. */
const lookAgainMs = 500;

/** What is seen in place of the streamed bone, in the frame of the bone at rest. */
export interface BoneReplacement {
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
  private instead: BoneReplacement | null = null;
  private settling: ReturnType<typeof setTimeout> | undefined;

  /** `onSettled` hears whenever regions are drawn otherwise without a call from outside: each wants a picture of its own. */
  constructor(private readonly onSettled: () => void) {}

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
    this.paint.setBonePose(worldFromBoneRest);
  }

  /** How much of it is seen: opacity 0 to 1; what lies on the negative side of any plane (world frame) is left out. */
  setLook(opacity: number, cuts: Plane[]): void {
    lookOfBone(this.paint.material, opacity, cuts);
    this.instead?.setLook(opacity, cuts);
  }

  /** Shows something else in the bone's place; null: the bone again. */
  replaceBone(other: BoneReplacement | null): void {
    this.instead?.object.removeFromParent();
    this.instead = other;
    if (other !== null) this.group.add(other.object);
    if (this.shown !== null) this.shown.group.visible = other === null;
  }

  dispose(): void {
    clearTimeout(this.settling);
    this.replaceBone(null);
    this.shown?.dispose();
    this.incoming?.dispose();
    this.paint.dispose();
  }

  apply(mesh: MeshDelta): void {
    const picture = this.incoming ?? this.shown;
    if (picture === null) return;
    for (const block of mesh.blocks) picture.apply(block, performance.now());
    if (mesh.keyComplete && mesh.simplerFollow !== true) picture.whole();
    if (mesh.keyComplete && this.incoming !== null) this.show(this.incoming);
    this.settleAfter(settleEveryMs);
  }

  /** Surfaces of fewer triangles in place of a whole picture's. */
  simplify(blocks: readonly BlockSurface[]): void {
    for (const block of blocks) this.shown?.apply(block, performance.now());
    this.shown?.whole();
    this.settleAfter(settleEveryMs);
  }

  get blockCount(): number {
    return this.shown?.blockCount ?? 0;
  }

  private settleAfter(waitMs: number): void {
    if (this.settling !== undefined || this.shown?.restless !== true) return;
    this.settling = setTimeout(() => {
      this.settling = undefined;
      const more = this.shown?.settleOne(performance.now()) === true;
      if (more) this.onSettled();
      this.settleAfter(more ? settleEveryMs : lookAgainMs);
    }, waitMs);
  }

  private show(picture: BonePicture): void {
    this.shown?.dispose();
    this.shown = picture;
    this.incoming = null;
    picture.group.visible = this.instead === null;
    this.group.add(picture.group);
  }
}
