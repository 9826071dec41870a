import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';

import { limited, PlanFrame, sidewaysMaxMm, type Ray } from '../../src/practice/plan_frame';
import type { Triple } from '../../src/wire/messages';

const oblique: Triple = [-0.92, 0.35, 0.17];
const plan = new PlanFrame({ axisEntryMm: [12, -30, 100], axisDirection: oblique });

/** The line of sight from `from` to a place in the world. */
function sight(from: Vector3, to: Vector3): Ray {
  return { origin: from, direction: to.clone().sub(from).normalize() };
}

describe('PlanFrame', () => {
  it('has directions square to each other, superior up and anterior to the front', () => {
    for (const axisDirection of [oblique, [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, -1]] as Triple[]) {
      const frame = new PlanFrame({ axisEntryMm: [0, 0, 0], axisDirection });
      expect(frame.axis.length()).toBeCloseTo(1, 12);
      expect(frame.superior.length()).toBeCloseTo(1, 12);
      expect(frame.anterior.length()).toBeCloseTo(1, 12);
      expect(frame.axis.dot(frame.superior)).toBeCloseTo(0, 12);
      expect(frame.axis.dot(frame.anterior)).toBeCloseTo(0, 12);
      expect(frame.superior.dot(frame.anterior)).toBeCloseTo(0, 12);
    }
    expect(plan.superior.z).toBeGreaterThan(0.9);
    expect(plan.anterior.y).toBeLessThan(-0.9);
  });

  it('finds the place that was looked at, from any side, whatever lies along the axis', () => {
    const eyes = [
      plan.entry.clone().addScaledVector(plan.axis, -150),
      new Vector3(150, -90, 140),
      plan.entry.clone().addScaledVector(plan.axis, -60).addScaledVector(plan.superior, 90),
    ];
    for (const eye of eyes) {
      for (const place of [
        { superior: 0, anterior: 0 },
        { superior: 7.5, anterior: -3 },
        { superior: -11, anterior: 12 },
      ]) {
        const looked = plan.entry.clone().add(plan.sideways(place));
        const found = plan.placeUnder(sight(eye, looked), { superior: 1, anterior: 1 });
        expect(found.superior).toBeCloseTo(place.superior, 9);
        expect(found.anterior).toBeCloseTo(place.anterior, 9);
      }
    }
  });

  it('keeps what a grazing sight cannot tell', () => {
    const eye = plan.entry.clone().addScaledVector(plan.anterior, 200);
    const now = { superior: 2, anterior: 5 };
    const looked = plan.entry.clone().add(plan.sideways({ superior: -4, anterior: 5 }));
    const found = plan.placeUnder(sight(eye, looked), now);
    expect(found.superior).toBeCloseTo(-4, 1);
    expect(found.anterior).toBeCloseTo(5, 0);
  });

  it('stays where it is when the sight goes away from the plane', () => {
    const eye = plan.entry.clone().addScaledVector(plan.axis, -100);
    const now = { superior: 2, anterior: 5 };
    expect(plan.placeUnder({ origin: eye, direction: plan.axis.clone().negate() }, now)).toEqual(now);
  });

  it('goes no farther from the plan than a hand may', () => {
    const eye = plan.entry.clone().addScaledVector(plan.axis, -100);
    const far = plan.entry.clone().add(plan.sideways({ superior: 30, anterior: -40 }));
    const found = plan.placeUnder(sight(eye, far), { superior: 0, anterior: 0 });
    expect(Math.hypot(found.superior, found.anterior)).toBeCloseTo(sidewaysMaxMm, 9);
    expect(found.superior / found.anterior).toBeCloseTo(30 / -40, 9);
    expect(limited({ superior: 1, anterior: 2 }, 3)).toEqual({ superior: 1, anterior: 2 });
  });

  it('leans by the angle that is asked for, the handle to the side that is named', () => {
    expect(plan.leant({ superior: 0, anterior: 0 }).distanceTo(plan.axis)).toBeCloseTo(0, 12);
    const leant = plan.leant({ superior: 12, anterior: 0 });
    expect((leant.angleTo(plan.axis) * 180) / Math.PI).toBeCloseTo(12, 9);
    // The handle is behind the tool's tip: up when the axis points down.
    expect(leant.clone().negate().dot(plan.superior)).toBeGreaterThan(0);
    expect(plan.leant({ superior: 0, anterior: -9 }).dot(plan.anterior)).toBeGreaterThan(0);
  });
});
