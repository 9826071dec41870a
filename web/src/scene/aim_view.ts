import {
  BufferGeometry,
  CircleGeometry,
  Group,
  Line,
  LineBasicMaterial,
  type Material,
  Mesh,
  MeshBasicMaterial,
  Quaternion,
  RingGeometry,
  Vector3,
} from 'three';

import type { Beside, PlanFrame } from '../practice/plan_frame';

const planColour = 0x0b8f6a;
const aimColour = 0xe07b00;
const axisLengthMm = 40;

/** The planned entry and axis, and where the hand aims; drawn over everything, since the reamer covers the place. */
export class AimView {
  readonly group = new Group();
  private readonly plan = new Group();
  private readonly aim = new Group();
  private wanted = true;
  private planned = false;

  constructor() {
    this.plan.add(
      onTop(new Mesh(new RingGeometry(2.6, 3.1, 48), new MeshBasicMaterial({ color: planColour })), 0.75),
      onTop(new Line(lineAlongAxis(), new LineBasicMaterial({ color: planColour })), 0.6),
    );
    this.aim.add(
      onTop(new Mesh(new CircleGeometry(0.7, 24), new MeshBasicMaterial({ color: aimColour })), 0.95),
      onTop(new Mesh(new RingGeometry(1.5, 1.8, 40), new MeshBasicMaterial({ color: aimColour })), 0.95),
    );
    this.group.add(this.plan, this.aim);
    this.group.visible = false;
  }

  /** Whether it may be seen at all. */
  setWanted(wanted: boolean): void {
    this.wanted = wanted;
    this.group.visible = wanted && this.planned;
  }

  set(plan: PlanFrame | null, place: Beside): void {
    this.planned = plan !== null;
    this.group.visible = this.wanted && this.planned;
    if (plan === null) return;
    // The flat shapes lie square to z and are seen from the side that z points to: away from the bone.
    const turned = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), plan.axis.clone().negate());
    for (const part of [this.plan, this.aim]) part.quaternion.copy(turned);
    this.plan.position.copy(plan.entry);
    this.aim.position.copy(plan.entry).add(plan.sideways(place));
  }
}

function lineAlongAxis(): BufferGeometry {
  return new BufferGeometry().setFromPoints([new Vector3(0, 0, 0), new Vector3(0, 0, axisLengthMm)]);
}

function onTop<T extends Mesh | Line>(shape: T, opacity: number): T {
  const material = shape.material as Material;
  material.transparent = true;
  material.opacity = opacity;
  material.depthTest = false;
  material.toneMapped = false;
  shape.renderOrder = 1;
  return shape;
}
