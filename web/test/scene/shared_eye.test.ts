import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';

import { PlanFrame } from '../../src/practice/plan_frame';
import { eyeFromPlan, eyeOnPlan, isSameEye } from '../../src/scene/shared_eye';

const right = new PlanFrame({ axisEntryMm: [-120, 5, 20], axisDirection: [0.97, 0.2, -0.1] });
const left = new PlanFrame({ axisEntryMm: [120, 5, 20], axisDirection: [-0.97, 0.2, -0.1] });
const eye = {
  target: new Vector3(-118, 4, 22),
  towardsEye: new Vector3(-0.9, -0.3, 0.2).normalize(),
  up: new Vector3(0, 0, 1),
  distanceMm: 140,
};

describe('one camera for two bones', () => {
  it('is the same camera on the same plan', () => {
    const back = eyeFromPlan(eyeOnPlan(eye, right), right);
    expect(back.target.distanceTo(eye.target)).toBeLessThan(1e-9);
    expect(back.towardsEye.distanceTo(eye.towardsEye)).toBeLessThan(1e-9);
    expect(back.up.distanceTo(eye.up)).toBeLessThan(1e-9);
    expect(isSameEye(eyeOnPlan(eye, right), eyeOnPlan(back, right))).toBe(true);
  });
  it('sees the other shoulder as a mirror would show it', () => {
    const there = eyeFromPlan(eyeOnPlan(eye, right), left);
    const mirrored = (v: Vector3) => new Vector3(-v.x, v.y, v.z);
    expect(there.target.distanceTo(mirrored(eye.target))).toBeLessThan(1e-9);
    expect(there.towardsEye.distanceTo(mirrored(eye.towardsEye))).toBeLessThan(1e-9);
  });
  it('is another one when it was moved, turned or zoomed', () => {
    const on = eyeOnPlan(eye, right);
    const other = { ...eye, towardsEye: new Vector3(-0.9, -0.31, 0.2).normalize() };
    expect(isSameEye(on, eyeOnPlan({ ...eye, distanceMm: 141 }, right))).toBe(false);
    expect(isSameEye(on, eyeOnPlan(other, right))).toBe(false);
    expect(isSameEye(on, eyeOnPlan({ ...eye, target: new Vector3(-118, 4, 22.1) }, right))).toBe(false);
  });
});
