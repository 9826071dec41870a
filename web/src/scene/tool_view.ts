import { BufferAttribute, BufferGeometry, Group, Mesh, MeshStandardMaterial, Quaternion, Vector3 } from 'three';
import { mergeVertices, toCreasedNormals } from 'three/examples/jsm/utils/BufferGeometryUtils.js';

import type { ToolAction } from '../state/tool_action';
import type { Pose, ToolMesh } from '../wire/messages';
import { Debris, type Source } from './debris';
import { DebrisView } from './debris_view';
import { creaseRad } from './solid_shapes';
import { glassColour, plainShaft, SteelParts, type ToolLook } from './tool_parts';
import { profileOf, type ToolProfile } from './tool_profile';
import { lipPitchRad } from './tool_shape';
import { Spin } from './tool_spin';

const steelColour = 0xb4c0c6;
const glassOpacity: Record<ToolLook, number> = { glass: 0.5, throughBone: 0.8, steel: 1 };

/**
 * The reamer where the server says it is. Plain: the cutting envelope, see-through so that the bone under it can be
 * judged, and a shaft. In full: an instrument of steel that follows the envelope, turns and throws chips, in a faint
 * envelope. What is no body of revolution is always plain.
 */
export class ToolView {
  readonly group = new Group();
  /** Where the reamer is. */
  private readonly placed = new Group();
  private readonly glass = new MeshStandardMaterial({
    color: glassColour,
    roughness: 0.28,
    metalness: 0.1,
    transparent: true,
    opacity: glassOpacity.glass,
  });
  private readonly shaftMaterial = new MeshStandardMaterial({ color: 0xd3dade, roughness: 0.45, metalness: 0.1 });
  private envelope: Mesh | null = null;
  private shaft: Mesh | null = null;
  private mesh: ToolMesh | null = null;
  /** Of that mesh; undefined: nobody has asked for it yet. */
  private profile: ToolProfile | null | undefined;
  private steel: SteelParts | null = null;
  private readonly spin = new Spin(lipPitchRad);
  private readonly debris = new Debris();
  private readonly debrisView = new DebrisView();
  private action: ToolAction | null = null;
  private look: ToolLook = 'glass';
  private boneIsWhole = true;
  private wantsFull = false;
  private posed = false;
  private wanted = true;

  /** `still`: whether people here want nothing to move. */
  constructor(private readonly still: { readonly matches: boolean }) {
    this.group.add(this.placed, this.debrisView.mesh);
  }

  setMesh(tool: ToolMesh): void {
    this.clear();
    this.mesh = tool;
    if (tool.indices.length > 0) {
      const indexed = new BufferGeometry();
      indexed.setAttribute('position', new BufferAttribute(tool.positionsMm, 3));
      indexed.setIndex(new BufferAttribute(tool.indices, 1));
      this.envelope = new Mesh(mergeVertices(toCreasedNormals(indexed, creaseRad)), this.glass);
      this.envelope.geometry.computeBoundingBox();
      this.shaft = plainShaft(this.envelope.geometry.boundingBox?.min.z ?? 0, this.shaftMaterial);
      this.placed.add(this.envelope, this.shaft);
    }
    this.refresh();
  }

  /** Not drawn until its first pose is known. */
  setPose(pose: Pose | null): void {
    this.posed = pose !== null;
    if (pose !== null) {
      this.placed.position.copy(new Vector3(...pose.translationMm));
      this.placed.quaternion.copy(new Quaternion(...pose.rotationXyzw));
    }
    this.refresh();
  }

  /**
   * Glass, so that the bone under it can be judged; steel in theatre. With bone that is seen through it is drawn first
   * and hides nothing, so that both are seen through each other. Chips are only seen on whole bone: they would lie
   * where it is cut away.
   */
  setLook(look: ToolLook, full: boolean, boneIsWhole: boolean): void {
    this.boneIsWhole = boneIsWhole && look !== 'throughBone';
    if (look === this.look && full === this.wantsFull) return;
    this.look = look;
    this.wantsFull = full;
    this.refresh();
  }

  setShown(shown: boolean): void {
    this.wanted = shown;
    this.refresh();
  }

  /** What it does; null: it rests. */
  setAction(action: ToolAction | null): void {
    this.action = action;
    this.debris.follow(this.moves ? action : null, this.source);
  }

  /** The next picture, so long after the last one; whether the one after it is another even if nothing is told. */
  step(seconds: number): boolean {
    const { steel, spin, debris } = this;
    if (steel === null) return false;
    const speed = this.moves ? (this.action?.spindleRadS ?? 0) : 0;
    if (speed === 0) spin.stand();
    else spin.turn(seconds, speed);
    steel.turn(spin.angle, spin.blur);
    const flies = debris.step(seconds, this.source);
    this.debrisView.show(debris, this.boneIsWhole && this.placed.visible);
    return speed !== 0 || flies;
  }

  dispose(): void {
    this.clear();
    this.glass.dispose();
    this.shaftMaterial.dispose();
    this.debrisView.dispose();
  }

  private get moves(): boolean {
    return this.steel !== null && this.placed.visible && !this.still.matches;
  }

  private get source(): Source | null {
    const { profile, placed } = this;
    return profile === null || profile === undefined ? null : { profile, at: placed.position, turn: placed.quaternion };
  }

  private clear(): void {
    for (const part of [this.envelope, this.shaft]) {
      part?.removeFromParent();
      part?.geometry.dispose();
    }
    this.dropSteel();
    this.envelope = this.shaft = this.mesh = null;
    this.profile = undefined;
    this.posed = false;
  }

  private makeSteel(): void {
    if (this.steel !== null || this.mesh === null) return;
    if (this.profile === undefined) this.profile = profileOf(this.mesh);
    if (this.profile === null) return;
    this.steel = new SteelParts(this.profile);
    this.placed.add(this.steel.group);
  }

  private dropSteel(): void {
    this.steel?.group.removeFromParent();
    this.steel?.dispose();
    this.steel = null;
    this.debris.follow(null, null);
    this.debrisView.show(this.debris, false);
  }

  private refresh(): void {
    this.placed.visible = this.posed && this.wanted;
    if (!this.placed.visible || !this.wantsFull) this.debris.follow(null, null);
    if (this.wantsFull) this.makeSteel();
    else if (this.steel !== null) this.dropSteel();
    this.steel?.setLook(this.look);
    for (const part of [this.envelope, this.shaft]) if (part !== null) part.visible = this.steel === null;
    this.dressEnvelope();
  }

  private dressEnvelope(): void {
    const { glass, look } = this;
    if (glass.transparent !== (look !== 'steel')) glass.needsUpdate = true;
    glass.transparent = look !== 'steel';
    glass.opacity = glassOpacity[look];
    glass.depthWrite = look !== 'throughBone';
    glass.color.set(look === 'steel' ? steelColour : glassColour);
  }
}
