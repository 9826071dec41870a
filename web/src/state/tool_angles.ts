import { Quaternion, Vector3 } from 'three';

import type { PlanFrame } from '../practice/plan_frame';
import type { Hello, Pose, Triple } from '../wire/messages';

/** Directions by which a face of the glenoid is named, unit, world frame. */
export interface FaceFrame {
  lateral: Vector3;
  superior: Vector3;
  posterior: Vector3;
  /** By the landmarks of the scapula; otherwise by the plan, and angles are differences from it. */
  scapular: boolean;
}

/** Landmarks that tell how the scapula lies, mm, world frame. */
export interface ScapulaPoints {
  glenoid_centre_mm?: Triple;
  trigonum_mm?: Triple;
  inferior_angle_mm?: Triple;
}

/** As the stream says it, which everybody sees who watches; else as the case says it to who may read it. */
export function scapulaPoints({ scapula }: Pick<Hello, 'scapula'>, ofCase: ScapulaPoints | null): ScapulaPoints | null {
  if (scapula === null) return ofCase;
  return {
    glenoid_centre_mm: scapula.glenoidCentreMm,
    trigonum_mm: scapula.trigonumMm,
    inferior_angle_mm: scapula.inferiorAngleMm,
  };
}

/** Degrees; retroversion is negative, superior inclination positive. */
export interface FaceAngles {
  versionDeg: number;
  inclinationDeg: number;
}

/** As the server's ScapularFrame (case/measures.hpp); by the plan where the landmarks do not say. */
export function faceFrame(plan: PlanFrame, points: ScapulaPoints | null): FaceFrame {
  return scapularFrame(points) ?? planFrame(plan);
}

function scapularFrame(points: ScapulaPoints | null): FaceFrame | null {
  if (points?.glenoid_centre_mm === undefined || points.trigonum_mm === undefined) return null;
  if (points.inferior_angle_mm === undefined) return null;
  const centre = new Vector3(...points.glenoid_centre_mm);
  const lateral = centre
    .clone()
    .sub(new Vector3(...points.trigonum_mm))
    .normalize();
  const toAngle = new Vector3(...points.inferior_angle_mm).sub(centre);
  const posterior = new Vector3().crossVectors(lateral, toAngle);
  if (posterior.length() < 1e-6) return null;
  posterior.normalize();
  // LPS: posterior is +y, whatever the order of the points.
  if (posterior.y < 0) posterior.negate();
  const superior = new Vector3().crossVectors(posterior, lateral);
  if (superior.dot(toAngle) > 0) superior.negate();
  return { lateral, superior, posterior, scapular: true };
}

function planFrame(plan: PlanFrame): FaceFrame {
  return {
    lateral: plan.axis.clone().negate(),
    superior: plan.superior,
    posterior: plan.anterior.clone().negate(),
    scapular: false,
  };
}

/** Version and inclination of a face that lies square to an axis into the bone. */
export function anglesOfAxis(intoBone: Vector3, frame: FaceFrame): FaceAngles {
  const face = intoBone.clone().negate();
  const lateral = face.dot(frame.lateral);
  return {
    versionDeg: degrees(-Math.atan2(face.dot(frame.posterior), lateral)),
    inclinationDeg: degrees(Math.atan2(face.dot(frame.superior), lateral)),
  };
}

/** Where the reamer's axis points seen from the bone, which may have moved. */
export function axisInBone(worldFromTool: Pose, worldFromBoneRest: Pose | null): Vector3 {
  const axis = new Vector3(0, 0, 1).applyQuaternion(new Quaternion(...worldFromTool.rotationXyzw));
  if (worldFromBoneRest === null) return axis;
  return axis.applyQuaternion(new Quaternion(...worldFromBoneRest.rotationXyzw).invert());
}

const degrees = (rad: number): number => (rad * 180) / Math.PI;
