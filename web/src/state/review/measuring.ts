import { Vector3 } from 'three';

import type { PlanFrame } from '../../practice/plan_frame';
import type { Triple } from '../../wire/messages';

/** What lies between two places of the bone, mm; depths are along the planned axis from its entry, into the bone. */
export interface Measured {
  distanceMm: number;
  firstDepthMm: number;
  secondDepthMm: number;
  /** From the first to the second along the axis; positive deeper. */
  alongMm: number;
  /** Across the axis. */
  acrossMm: number;
}

/** How far a place is past the planned entry along the planned axis, mm. */
export function depthMm(place: Triple, plan: PlanFrame): number {
  return new Vector3(...place).sub(plan.entry).dot(plan.axis);
}

/** How far a place is beside the planned axis, mm. */
export function offAxisMm(place: Triple, plan: PlanFrame): number {
  const from = new Vector3(...place).sub(plan.entry);
  return from.addScaledVector(plan.axis, -from.dot(plan.axis)).length();
}

/** Both places in one frame with the plan. */
export function measured(first: Triple, second: Triple, plan: PlanFrame): Measured {
  const between = new Vector3(...second).sub(new Vector3(...first));
  const alongMm = between.dot(plan.axis);
  return {
    distanceMm: between.length(),
    firstDepthMm: depthMm(first, plan),
    secondDepthMm: depthMm(second, plan),
    alongMm,
    acrossMm: between.addScaledVector(plan.axis, -alongMm).length(),
  };
}

/** The places after another one was pointed at: two are a measurement, a third begins the next. */
export function withPlace<Place>(places: readonly Place[], next: Place): Place[] {
  return places.length >= 2 ? [next] : [...places, next];
}
