import { Quaternion, Vector3 } from 'three';

import { PlanFrame } from '../practice/plan_frame';
import type { Hello, Pose, Telemetry } from '../wire/messages';
import { axisInBone } from './tool_angles';

/** The reamer against the planned axis, in the bone as it lies now. */
export interface ToolOnPlan {
  /** How far its apex is past the planned entry along the axis, mm. */
  depthMm: number;
  /** How far its apex is from the axis, mm. */
  besideMm: number;
  leanDeg: number;
}

export function toolOnPlan(
  hello: Pick<Hello, 'axisEntryMm' | 'axisDirection'>,
  { worldFromTool, worldFromBoneRest }: Pick<Telemetry, 'worldFromTool' | 'worldFromBoneRest'>,
): ToolOnPlan | null {
  if (worldFromTool === null) return null;
  const plan = new PlanFrame(hello);
  const way = atRest(new Vector3(...worldFromTool.translationMm), worldFromBoneRest).sub(plan.entry);
  const { superior, anterior } = plan.beside(way);
  const cosine = axisInBone(worldFromTool, worldFromBoneRest).dot(plan.axis);
  return {
    depthMm: way.dot(plan.axis),
    besideMm: Math.hypot(superior, anterior),
    leanDeg: (Math.acos(Math.min(Math.max(cosine, -1), 1)) * 180) / Math.PI,
  };
}

function atRest(world: Vector3, worldFromBoneRest: Pose | null): Vector3 {
  if (worldFromBoneRest === null) return world;
  const turn = new Quaternion(...worldFromBoneRest.rotationXyzw).invert();
  return world.sub(new Vector3(...worldFromBoneRest.translationMm)).applyQuaternion(turn);
}
