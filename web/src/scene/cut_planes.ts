import { Plane, Vector3 } from 'three';

import type { PlanFrame } from '../practice/plan_frame';
import { sectionNames, type SectionName, type ViewChoices } from '../state/view_settings';

/** Below this a view runs along the axis so nearly that it does not say which half is the nearer. */
const alongAxis = 0.2;

/** LPS: superior is z, anterior -y; outside is the side that the plan comes from. */
function outwards(name: SectionName, plan: PlanFrame): Vector3 {
  if (name === 'axial') return new Vector3(0, 0, 1);
  if (name === 'coronal') return new Vector3(0, -1, 0);
  return new Vector3(plan.axis.x > 0 ? -1 : 1, 0, 0);
}

/** The patient's planes that are on; bone on their negative side is cut away. World frame. */
export function sectionPlanes(sections: ViewChoices['sections'], plan: PlanFrame): Plane[] {
  return sectionNames.flatMap((name) => {
    const { on, offsetMm, flipped } = sections[name];
    if (!on) return [];
    const out = outwards(name, plan);
    const through = plan.entry.clone().addScaledVector(out, offsetMm);
    return [new Plane().setFromNormalAndCoplanarPoint(flipped ? out : out.negate(), through)];
  });
}

/** Through the reamer's axis (unit), square to the sight: what is nearer to the eye is on its negative side. */
export function planeThroughAxis(at: Vector3, axis: Vector3, eye: Vector3, up: Vector3): Plane {
  const towardsEye = eye.clone().sub(at).normalize();
  const square = towardsEye.addScaledVector(axis, -towardsEye.dot(axis));
  if (square.length() < alongAxis) square.copy(up).addScaledVector(axis, -up.dot(axis));
  return new Plane().setFromNormalAndCoplanarPoint(square.normalize().negate(), at);
}
