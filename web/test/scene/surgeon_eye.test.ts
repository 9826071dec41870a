import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';

import { PlanFrame } from '../../src/practice/plan_frame';
import { arrived, gone, surgeonsEye } from '../../src/scene/surgeon_eye';

const plans = [
  new PlanFrame({ axisEntryMm: [-100, 20, 50], axisDirection: [1, 0.1, -0.05] }),
  new PlanFrame({ axisEntryMm: [100, 20, 50], axisDirection: [-1, 0.1, -0.05] }),
];

describe('the surgeon at the beach chair', () => {
  it('looks onto the face from outside, from in front and above, on either side', () => {
    for (const plan of plans) {
      const { towardsEye, up, target } = surgeonsEye(plan, null);
      expect(target).toEqual(plan.entry);
      expect(towardsEye.length()).toBeCloseTo(1, 12);
      expect(towardsEye.dot(plan.axis)).toBeLessThan(-0.7);
      expect(towardsEye.y).toBeLessThan(0);
      expect(towardsEye.dot(up)).toBeGreaterThan(0.2);
      // The patient leans back by 30 degrees: up has a part towards the front.
      expect(Math.atan2(-up.y, up.z)).toBeCloseTo(Math.PI / 6, 9);
    }
  });

  it('follows the reamer beside the plan, not in and out, and not far', () => {
    const [plan] = plans as [PlanFrame];
    const beside = plan.sideways({ superior: 3, anterior: -4 });
    const tool = plan.entry.clone().add(beside).addScaledVector(plan.axis, -60);
    expect(surgeonsEye(plan, tool).target.distanceTo(plan.entry)).toBeCloseTo(5, 6);
    const away = plan.entry.clone().addScaledVector(plan.superior, 500);
    expect(surgeonsEye(plan, away).target.distanceTo(plan.entry)).toBeCloseTo(12, 6);
  });

  it('is reached in many small steps without a jump, however far it is', () => {
    const [plan] = plans as [PlanFrame];
    const goal = surgeonsEye(plan, null);
    for (const from of [new Vector3(0, 0, 1), goal.towardsEye.clone().negate(), new Vector3(0, 1, 0)]) {
      let now = { target: plan.entry.clone().add(from), towardsEye: from.clone(), up: new Vector3(0, 0, 1) };
      for (let i = 0; i < 200 && !arrived(now, goal); ++i) {
        const next = gone(now, goal, 0.1);
        expect(next.towardsEye.angleTo(now.towardsEye)).toBeLessThan(0.1 * Math.PI + 1e-6);
        expect(next.towardsEye.length()).toBeCloseTo(1, 9);
        expect(next.up.length()).toBeCloseTo(1, 9);
        now = next;
      }
      expect(arrived(now, goal)).toBe(true);
    }
  });
});
