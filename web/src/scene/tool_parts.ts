import { type BufferGeometry, CylinderGeometry, DoubleSide, Group, Mesh, MeshStandardMaterial } from 'three';

import { shadowed } from './lights';
import { hidesNothing, operatingRoom, steelMaterial } from './steel';
import { bladesOf, bodyOf, envelopeOf, sweptOf } from './tool_shape';
import type { ToolProfile } from './tool_profile';

export const glassColour = 0x8fb3c4;

export type ToolLook = 'glass' | 'throughBone' | 'steel';

const shaftRadiusMm = 3;
const shaftLengthMm = 45;
/** What is swept hides about as much as the blades did; in theatre nearly all of what is behind it. */
const sweptOpacity: Record<ToolLook, number> = { glass: 0.55, throughBone: 0.55, steel: 0.88 };

/** A plain shaft, which is not part of the model and only shows the axis, up to the head's back. */
export function plainShaft(backZMm: number, material: MeshStandardMaterial): Mesh {
  const shaft = new CylinderGeometry(shaftRadiusMm, shaftRadiusMm, shaftLengthMm, 40);
  shaft.rotateX(Math.PI / 2).translate(0, 0, backZMm - shaftLengthMm / 2);
  return new Mesh(shaft, material);
}

/**
 * The instrument in steel: its body, and its blades, which turn and are a blur when they turn fast; around them faint
 * glass shows how far they cut.
 */
export class SteelParts {
  readonly group = new Group();
  private readonly room = operatingRoom();
  private readonly bladeSteel = steelMaterial(0xf0f2f3, 0.22, this.room);
  private readonly bodySteel = steelMaterial(0xcdd2d5, 0.32, this.room);
  private readonly sweptSteel = steelMaterial(0xdfe3e6, 0.4, this.room);
  private readonly faintGlass = new MeshStandardMaterial({
    color: glassColour,
    roughness: 0.28,
    transparent: true,
    opacity: 0.22,
    depthWrite: false,
    side: DoubleSide,
  });
  private readonly farAway = hidesNothing();
  private readonly blades: Mesh;
  private readonly swept: Mesh;
  private readonly body: Mesh;
  private readonly envelope: Mesh;
  private readonly bladesAway: Mesh;
  private readonly bodyAway: Mesh;
  private look: ToolLook = 'glass';

  constructor(profile: ToolProfile) {
    this.body = shadowed(new Mesh(bodyOf(profile), this.bodySteel));
    this.blades = shadowed(new Mesh(bladesOf(profile), this.bladeSteel));
    this.swept = new Mesh(sweptOf(profile), this.sweptSteel);
    this.envelope = new Mesh(envelopeOf(profile), this.faintGlass);
    this.sweptSteel.transparent = true;
    this.sweptSteel.depthWrite = false;
    this.bodyAway = lastOf(this.body.geometry, this.farAway);
    this.bladesAway = lastOf(this.blades.geometry, this.farAway);
    this.blades.add(this.bladesAway);
    this.group.add(this.body, this.blades, this.swept, this.envelope, this.bodyAway);
    this.setLook(this.look);
    this.turn(0, 0);
  }

  /** Through bone, steel hides itself as it should, but nothing of the bone, which is drawn afterwards. */
  setLook(look: ToolLook): void {
    this.look = look;
    this.envelope.visible = look !== 'steel';
    this.bodyAway.visible = this.bladesAway.visible = look === 'throughBone';
  }

  /** Blades at this angle, that far a blur, 0 to 1. */
  turn(angle: number, blur: number): void {
    this.blades.rotation.z = angle;
    this.blades.visible = blur < 1;
    this.swept.visible = blur > 0;
    const { bladeSteel, sweptSteel } = this;
    if (bladeSteel.transparent !== blur > 0) {
      bladeSteel.transparent = blur > 0;
      bladeSteel.needsUpdate = true;
    }
    bladeSteel.opacity = 1 - blur;
    bladeSteel.depthWrite = blur < 0.5;
    sweptSteel.opacity = blur * sweptOpacity[this.look];
  }

  dispose(): void {
    for (const mesh of [this.body, this.blades, this.swept, this.envelope]) mesh.geometry.dispose();
    const { bladeSteel, bodySteel, sweptSteel, faintGlass, farAway } = this;
    for (const material of [bladeSteel, bodySteel, sweptSteel, faintGlass, farAway]) material.dispose();
    this.room.dispose();
  }
}

function lastOf(geometry: BufferGeometry, material: ReturnType<typeof hidesNothing>): Mesh {
  const mesh = new Mesh(geometry, material);
  mesh.renderOrder = 2;
  return mesh;
}
