import { Vector3 } from 'three';

import type { PlanFrame } from '../practice/plan_frame';
import type { EyePose } from './surgeon_eye';

/** From where something is seen, and how far away. */
export interface Eye extends EyePose {
  distanceMm: number;
}

/**
 * The same as it lies to a plan: along the planned axis, upwards and forwards. Two bones are seen alike with one of these,
 * wherever their CTs have them; a left and a right shoulder then are each other's mirror image.
 */
export interface EyeOnPlan {
  target: Vector3;
  towardsEye: Vector3;
  up: Vector3;
  distanceMm: number;
}

export function eyeOnPlan(eye: Eye, plan: PlanFrame): EyeOnPlan {
  const turned = (v: Vector3) => new Vector3(v.dot(plan.axis), v.dot(plan.superior), v.dot(plan.anterior));
  return {
    target: turned(eye.target.clone().sub(plan.entry)),
    towardsEye: turned(eye.towardsEye),
    up: turned(eye.up),
    distanceMm: eye.distanceMm,
  };
}

export function eyeFromPlan(eye: EyeOnPlan, plan: PlanFrame): Eye {
  const turned = ({ x, y, z }: Vector3) =>
    new Vector3().addScaledVector(plan.axis, x).addScaledVector(plan.superior, y).addScaledVector(plan.anterior, z);
  return {
    target: turned(eye.target).add(plan.entry),
    towardsEye: turned(eye.towardsEye),
    up: turned(eye.up),
    distanceMm: eye.distanceMm,
  };
}

/** Whether nobody could tell the two apart. */
export function isSameEye(a: EyeOnPlan, b: EyeOnPlan): boolean {
  return (
    a.target.distanceTo(b.target) < 1e-3 &&
    a.towardsEye.distanceTo(b.towardsEye) < 1e-5 &&
    Math.abs(a.distanceMm - b.distanceMm) < 1e-3
  );
}
