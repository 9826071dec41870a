import { Vector3 } from 'three';
import { beforeAll, describe, expect, it, vi } from 'vitest';

import { PlanFrame } from '../../src/practice/plan_frame';
import { SurgeonCamera } from '../../src/scene/surgeon_camera';
import type { EyePose } from '../../src/scene/surgeon_eye';

const plan = new PlanFrame({ axisEntryMm: [-100, 20, 50], axisDirection: [1, 0.1, -0.05] });
const theatreMm = 45;

class FakeOrbit {
  target = new Vector3(-98, 21, 47);
  towardsEye = new Vector3(-0.8, -0.6, 0);
  distanceMm = 140;
  eyePose = (up: Vector3): EyePose => ({ target: this.target.clone(), towardsEye: this.towardsEye.clone(), up });
  setEyePose(pose: EyePose, distanceMm: number): void {
    this.target = pose.target.clone();
    this.towardsEye = pose.towardsEye.clone();
    this.distanceMm = distanceMm;
  }
  fittingDistance = (radiusMm = 34) => radiusMm * 4;
}

beforeAll(() => {
  vi.stubGlobal('window', { matchMedia: () => ({ matches: false }) });
});

function place() {
  const orbit = new FakeOrbit();
  const camera = new SurgeonCamera(orbit);
  camera.setPlan(plan);
  const settle = () => {
    for (let i = 0; i < 400 && camera.step(0.05); ++i);
  };
  settle();
  return { orbit, camera, settle };
}

describe('the camera after theatre', () => {
  it('goes back to where it was before', () => {
    const { orbit, camera, settle } = place();
    camera.follow(true, theatreMm);
    settle();
    expect(orbit.target.distanceTo(plan.entry)).toBeLessThan(0.1);
    expect(orbit.distanceMm).toBeCloseTo(4 * theatreMm, 1);
    camera.follow(false);
    settle();
    expect(orbit.target.distanceTo(new Vector3(-98, 21, 47))).toBeLessThan(0.1);
    expect(orbit.towardsEye.distanceTo(new Vector3(-0.8, -0.6, 0))).toBeLessThan(0.01);
    expect(orbit.distanceMm).toBeCloseTo(140, 0);
    expect(camera.step(0.05)).toBe(false);
  });

  it('stays where somebody turns it meanwhile', () => {
    const { orbit, camera, settle } = place();
    camera.follow(true, theatreMm);
    settle();
    camera.follow(false);
    camera.step(0.05);
    camera.taken();
    orbit.distanceMm = 99;
    settle();
    expect(orbit.distanceMm).toBe(99);
  });

  it('frames the bone that theatre was on, where that is another one', () => {
    const { orbit, camera, settle } = place();
    camera.follow(true, theatreMm);
    orbit.setEyePose({ target: plan.entry, towardsEye: new Vector3(-1, 0, 0), up: new Vector3(0, 0, 1) }, 136);
    camera.framed();
    settle();
    camera.follow(false);
    settle();
    expect(orbit.target.distanceTo(plan.entry)).toBeLessThan(0.1);
    expect(orbit.distanceMm).toBeCloseTo(136, 0);
  });

  it('gives the surgeon’s eye back to who had chosen it, and stays there when that is ended', () => {
    const { orbit, camera, settle } = place();
    camera.follow(true);
    settle();
    camera.follow(true, theatreMm);
    settle();
    camera.follow(true);
    settle();
    expect(orbit.distanceMm).toBeCloseTo(136, 0);
    camera.follow(false);
    settle();
    expect(orbit.target.distanceTo(plan.entry)).toBeLessThan(0.1);
    expect(orbit.distanceMm).toBeCloseTo(136, 0);
  });
});
