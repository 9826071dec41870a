import {
  BufferAttribute,
  type BufferGeometry,
  Color,
  DoubleSide,
  Group,
  type Material,
  Matrix3,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  type Texture,
  Vector3,
} from 'three';

import type { PlanFrame } from '../practice/plan_frame';
import { humerusGeometry } from './humerus';
import { operatingLightFor, shadowed } from './lights';
import { operatingRoom, steelMaterial } from './steel';
import { surgeonsEye } from './surgeon_eye';
import { bladesGeometry, ringGeometry } from './retractors';
import { coverGeometries, woundGeometry } from './wound_shape';

/** Half of what is seen in theatre: the wound with its edges. */
export const theatreViewMm = 54;
const steelColour = new Color(0xc3ccd0);

/** How much a part shines; steel mirrors the room. */
type Gloss = 'wet' | 'moist' | 'dull' | 'steel';
const roughness: Record<Gloss, number> = { wet: 0.34, moist: 0.5, dull: 0.9, steel: 0.3 };

/**
 * What a surgeon sees around the glenoid: a wound that retractors hold open, the cut humerus held back, skin and drape.
 * Nothing of it is felt or picked. Made when it is first shown. In full it shines; plain it is lit once and for all from
 * where the surgeon stands, which costs next to nothing to draw.
 */
export class OperativeField {
  readonly group = new Group();
  private room: Texture | null = null;
  private plan: PlanFrame | null = null;
  private madeFull: boolean | null = null;

  constructor() {
    this.group.matrixAutoUpdate = false;
    this.group.visible = false;
  }

  /** It lies about a shoulder's planned axis, frame of the bone at rest; null: there is no shoulder. */
  setPlan(plan: PlanFrame | null): void {
    // A connection that begins again has the same plan.
    if (plan !== null && this.plan?.entry.equals(plan.entry) === true && this.plan.axis.equals(plan.axis)) return;
    this.drop();
    this.plan = plan;
    if (plan === null) return;
    this.group.matrix.copy(restFromField(plan));
    this.group.matrixWorldNeedsUpdate = true;
  }

  setShown(shown: boolean, full: boolean): void {
    const { group, plan } = this;
    group.visible = shown && plan !== null;
    if (!shown || plan === null || full === this.madeFull) return;
    this.drop();
    this.madeFull = full;
    for (const [geometry, gloss] of fieldParts())
      group.add(
        full ? shadowed(new Mesh(geometry, this.shining(gloss))) : new Mesh(litOnce(geometry, plan), plainMaterial()),
      );
  }

  dispose(): void {
    this.drop();
  }

  private shining(gloss: Gloss): Material {
    if (gloss !== 'steel')
      return new MeshStandardMaterial({
        vertexColors: true,
        side: DoubleSide,
        roughness: roughness[gloss],
        metalness: 0,
      });
    this.room ??= operatingRoom();
    return steelMaterial(steelColour.getHex(), roughness.steel, this.room);
  }

  private drop(): void {
    for (const mesh of this.group.children as Mesh<BufferGeometry, Material>[]) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
    this.group.clear();
    this.room?.dispose();
    this.room = null;
    this.madeFull = null;
  }
}

/** From superior, anterior and lateral of the entry. */
export function restFromField(plan: PlanFrame): Matrix4 {
  return new Matrix4().makeBasis(plan.superior, plan.anterior, plan.axis.clone().negate()).setPosition(plan.entry);
}

/** In the field's frame. */
export function fieldParts(): [geometry: BufferGeometry, gloss: Gloss][] {
  const { skin, drape } = coverGeometries();
  return [
    [woundGeometry(), 'wet'],
    [humerusGeometry(), 'wet'],
    [skin, 'moist'],
    [drape, 'dull'],
    [bladesGeometry(), 'steel'],
    [ringGeometry(), 'steel'],
  ];
}

const plainMaterial = () => new MeshBasicMaterial({ vertexColors: true, side: DoubleSide });

/** Its colours as they are seen by the surgeon. */
function litOnce(geometry: BufferGeometry, plan: PlanFrame): BufferGeometry {
  const { towardsEye, up } = surgeonsEye(plan, null);
  const light = operatingLightFor(towardsEye, up);
  const turn = new Matrix3().setFromMatrix4(restFromField(plan));
  const normals = geometry.getAttribute('normal');
  const own = geometry.hasAttribute('color') ? geometry.getAttribute('color') : null;
  const colours = new Float32Array(3 * normals.count);
  const normal = new Vector3();
  const colour = new Color();
  for (let i = 0; i < normals.count; ++i) {
    normal.fromBufferAttribute(normals, i).applyMatrix3(turn);
    if (own === null) {
      colour.copy(steelColour);
      // Of a thin blade that side counts which is seen.
      if (normal.dot(towardsEye) < 0) normal.negate();
    } else colour.fromBufferAttribute(own, i);
    colour.multiply(light(normal)).toArray(colours, 3 * i);
  }
  geometry.setAttribute('color', new BufferAttribute(colours, 3));
  return geometry;
}
