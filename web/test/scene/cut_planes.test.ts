import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';

import { PlanFrame } from '../../src/practice/plan_frame';
import { planeThroughAxis, sectionPlanes } from '../../src/scene/cut_planes';
import { plainView, type Section, type SectionName } from '../../src/state/view_settings';

// A right shoulder: the patient's right is -x, so that the plan goes inwards along +x.
const right = new PlanFrame({ axisEntryMm: [-100, 20, 50], axisDirection: [1, 0, 0] });
const left = new PlanFrame({ axisEntryMm: [100, 20, 50], axisDirection: [-1, 0, 0] });

const planes = (name: SectionName, part: Partial<Section>, plan = right) =>
  sectionPlanes({ ...plainView.sections, [name]: { on: true, offsetMm: 0, flipped: false, ...part } }, plan);
const kept = (point: Vector3, name: SectionName, part: Partial<Section> = {}, plan = right) =>
  planes(name, part, plan).every((plane) => plane.distanceToPoint(point) >= 0);

describe('sections', () => {
  it('cut nothing while they are off', () => {
    expect(sectionPlanes(plainView.sections, right)).toEqual([]);
  });

  it('cut away what is above, in front and outside, and the other side when flipped', () => {
    const above = new Vector3(-100, 20, 51);
    const front = new Vector3(-100, 19, 50);
    const outside = new Vector3(-101, 20, 50);
    for (const [point, name] of [
      [above, 'axial'],
      [front, 'coronal'],
      [outside, 'sagittal'],
    ] as const) {
      expect(kept(point, name)).toBe(false);
      expect(kept(point, name, { flipped: true })).toBe(true);
      expect(kept(point, name, { offsetMm: 2 })).toBe(true);
      expect(kept(point, name, { offsetMm: -2, flipped: true })).toBe(true);
    }
  });

  it('know that outside is the other way on the other shoulder', () => {
    expect(kept(new Vector3(101, 20, 50), 'sagittal', {}, left)).toBe(false);
    expect(kept(new Vector3(99, 20, 50), 'sagittal', {}, left)).toBe(true);
  });
});

describe('the cut through the axis of the reamer', () => {
  const up = new Vector3(0, 0, 1);

  it('holds the whole axis and takes the half that is nearer to the eye', () => {
    const at = new Vector3(3, -2, 5);
    const axis = new Vector3(1, 0.2, -0.1).normalize();
    const eye = new Vector3(40, -80, 30);
    const plane = planeThroughAxis(at, axis, eye, up);
    for (const along of [-20, 0, 35])
      expect(plane.distanceToPoint(at.clone().addScaledVector(axis, along))).toBeCloseTo(0, 9);
    expect(plane.distanceToPoint(eye)).toBeLessThan(0);
    expect(plane.normal.length()).toBeCloseTo(1, 12);
  });

  it('takes the upper half where the sight runs along the axis', () => {
    const plane = planeThroughAxis(new Vector3(), new Vector3(1, 0, 0), new Vector3(-90, 0, 0.5), up);
    expect(plane.distanceToPoint(new Vector3(0, 0, 10))).toBeCloseTo(-10, 9);
  });
});
