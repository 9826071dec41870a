import { Quaternion, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';

import { PlanFrame } from '../../src/practice/plan_frame';
import { anglesOfAxis, axisInBone, faceFrame, scapulaPoints } from '../../src/state/tool_angles';

const rad = Math.PI / 180;

/** A right scapula that lies straight: lateral is -x, superior z, posterior y. */
const straight = {
  glenoid_centre_mm: [-100, 0, 0],
  trigonum_mm: [0, 0, 0],
  inferior_angle_mm: [-10, 0, -120],
} as const;
const plan = new PlanFrame({ axisEntryMm: [-100, 0, 0], axisDirection: [1, 0, 0] });

/** Into the bone, of a face with these angles on that scapula: tan adds up, as in science's definition. */
const into = (versionDeg: number, inclinationDeg: number) =>
  new Vector3(-1, -Math.tan(versionDeg * rad), Math.tan(inclinationDeg * rad)).normalize().negate();

describe('version and inclination of the reamer', () => {
  it('are those of a face square to its axis, by the landmarks of the scapula', () => {
    const frame = faceFrame(plan, { ...straight });
    expect(frame.scapular).toBe(true);
    for (const [version, inclination] of [
      [0, 0],
      [-12, 5],
      [8, -3],
      [-30, 20],
    ] as const) {
      const found = anglesOfAxis(into(version, inclination), frame);
      expect(found.versionDeg).toBeCloseTo(version, 9);
      expect(found.inclinationDeg).toBeCloseTo(inclination, 9);
    }
  });

  it('are against what the stream says of the scapula, which viewers get too, before what the case says', () => {
    const scapula = {
      glenoidCentreMm: straight.glenoid_centre_mm,
      trigonumMm: straight.trigonum_mm,
      inferiorAngleMm: straight.inferior_angle_mm,
    };
    const other = { ...straight, trigonum_mm: [0, 50, 0] as const };
    expect(scapulaPoints({ scapula }, null)).toEqual(straight);
    expect(scapulaPoints({ scapula }, other)).toEqual(straight);
    expect(scapulaPoints({ scapula: null }, other)).toEqual(other);
    expect(scapulaPoints({ scapula: null }, null)).toBeNull();
  });

  it('are the same on the mirrored scapula', () => {
    const mirror = ([x, y, z]: readonly [number, number, number]) => [-x, y, z] as const;
    const frame = faceFrame(plan, {
      glenoid_centre_mm: mirror(straight.glenoid_centre_mm),
      trigonum_mm: mirror(straight.trigonum_mm),
      inferior_angle_mm: mirror(straight.inferior_angle_mm),
    });
    const axis = into(-12, 5);
    axis.x = -axis.x;
    expect(anglesOfAxis(axis, frame).versionDeg).toBeCloseTo(-12, 9);
    expect(anglesOfAxis(axis, frame).inclinationDeg).toBeCloseTo(5, 9);
  });

  it('turn with the scapula as a whole', () => {
    const turn = new Quaternion().setFromAxisAngle(new Vector3(1, 2, 3).normalize(), 0.3);
    const turned = (p: readonly [number, number, number]) => new Vector3(...p).applyQuaternion(turn).toArray();
    const frame = faceFrame(plan, {
      glenoid_centre_mm: turned(straight.glenoid_centre_mm),
      trigonum_mm: turned(straight.trigonum_mm),
      inferior_angle_mm: turned(straight.inferior_angle_mm),
    });
    expect(anglesOfAxis(into(-7, 4).applyQuaternion(turn), frame).versionDeg).toBeCloseTo(-7, 9);
  });

  it('are differences from the plan without landmarks', () => {
    for (const points of [null, {}, { ...straight, inferior_angle_mm: [-50, 0, 0] as const }]) {
      const frame = faceFrame(plan, points);
      expect(frame.scapular).toBe(false);
      expect(anglesOfAxis(plan.axis, frame).versionDeg).toBeCloseTo(0, 12);
      expect(anglesOfAxis(into(-4, 6), frame).versionDeg).toBeCloseTo(-4, 9);
      expect(anglesOfAxis(into(-4, 6), frame).inclinationDeg).toBeCloseTo(6, 9);
    }
  });

  it('stay when bone and reamer move together', () => {
    const move = new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), 0.2);
    const tool = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), into(-9, 2));
    const pose = (q: Quaternion) => ({ rotationXyzw: q.toArray(), translationMm: [0, 0, 0] as const });
    const still = axisInBone(pose(tool), null);
    const moved = axisInBone(pose(move.clone().multiply(tool)), pose(move));
    expect(moved.distanceTo(still)).toBeLessThan(1e-9);
  });
});
