import { Vector3 } from 'three';

import type { PlanFrame } from '../practice/plan_frame';

/**
 * The back of a beach chair is raised by about 60 degrees, so that the patient leans back by 30; the surgeon stands
 * beside the shoulder, a little in front of and above the open glenoid.
 */
const leansBackRad = Math.PI / 6;
const eyeAnterior = 0.36;
const eyeAbove = 0.34;
/** The eye follows the reamer beside the plan up to here. */
const followsMm = 12;

/** What the surgeon looks at, from which direction, and which way is up; world frame. */
export interface EyePose {
  target: Vector3;
  /** Unit, from the target to the eye. */
  towardsEye: Vector3;
  up: Vector3;
}

/** The surgeon's eye at the beach chair; `tool` is where the reamer's tip is, null where that is not known. */
export function surgeonsEye(plan: PlanFrame, tool: Vector3 | null): EyePose {
  // LPS: superior is z, anterior -y.
  const up = new Vector3(0, -Math.sin(leansBackRad), Math.cos(leansBackRad));
  const towardsEye = plan.axis.clone().negate();
  towardsEye.addScaledVector(plan.anterior, eyeAnterior).addScaledVector(up, eyeAbove).normalize();
  const target = plan.entry.clone();
  if (tool !== null) {
    const beside = plan.sideways(plan.beside(tool.clone().sub(plan.entry)));
    target.add(beside.clampLength(0, followsMm));
  }
  return { target, towardsEye, up };
}

/** `now` after it has gone towards `goal` for a while; `share` of the way, 0 to 1. The distance is left alone. */
export function gone(now: EyePose, goal: EyePose, share: number): EyePose {
  return {
    target: now.target.clone().lerp(goal.target, share),
    towardsEye: turned(now.towardsEye, goal.towardsEye, share),
    up: turned(now.up, goal.up, share),
  };
}

/** Whether nobody could tell the two apart. */
export function arrived(now: EyePose, goal: EyePose): boolean {
  const apart = now.towardsEye.distanceTo(goal.towardsEye) + now.up.distanceTo(goal.up);
  return apart < 1e-3 && now.target.distanceTo(goal.target) < 0.02;
}

/** On the great circle between two unit vectors; opposite ones turn about any axis square to them. */
function turned(from: Vector3, to: Vector3, share: number): Vector3 {
  const angle = from.angleTo(to);
  if (angle < 1e-6) return to.clone();
  const axis = new Vector3().crossVectors(from, to);
  if (axis.lengthSq() < 1e-10)
    axis.crossVectors(from, Math.abs(from.z) < 0.9 ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0));
  return from
    .clone()
    .applyAxisAngle(axis.normalize(), angle * share)
    .normalize();
}
