import { Quaternion, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';

import { PlanFrame } from '../../../src/practice/plan_frame';
import { depthMm, measured, offAxisMm, withPlace } from '../../../src/state/review/measuring';
import type { Triple } from '../../../src/wire/messages';

const plan = new PlanFrame({ axisEntryMm: [10, 20, 30], axisDirection: [-1, 0, 0] });

describe('measuring', () => {
  it('says distance, depth from the planned entry, and how both lie to the axis', () => {
    const found = measured([10, 20, 30], [8, 23, 34], plan);
    expect(found.distanceMm).toBeCloseTo(Math.hypot(2, 3, 4));
    expect(found.firstDepthMm).toBeCloseTo(0);
    expect(found.secondDepthMm).toBeCloseTo(2);
    expect(found.alongMm).toBeCloseTo(2);
    expect(found.acrossMm).toBeCloseTo(5);
    expect(depthMm([11, 20, 30], plan)).toBeCloseTo(-1);
    expect(offAxisMm([0, 23, 34], plan)).toBeCloseTo(5);
  });

  it('does not change when bone and plan are moved together', () => {
    const turn = new Quaternion().setFromAxisAngle(new Vector3(0.3, -0.8, 0.5).normalize(), 1.1);
    const shift = new Vector3(-40, 7, 90);
    const moved = (place: Triple) =>
      new Vector3(...place).applyQuaternion(turn).add(shift).toArray() as unknown as Triple;
    const direction: Triple = [0.6, 0.64, 0.48];
    const entry: Triple = [1, 2, 3];
    const [first, second]: [Triple, Triple] = [
      [4, -2, 7],
      [-3, 5, 1],
    ];
    const still = measured(first, second, new PlanFrame({ axisEntryMm: entry, axisDirection: direction }));
    const turned = new Vector3(...direction).applyQuaternion(turn).toArray() as unknown as Triple;
    const there = measured(
      moved(first),
      moved(second),
      new PlanFrame({ axisEntryMm: moved(entry), axisDirection: turned }),
    );
    for (const key of Object.keys(still) as (keyof typeof still)[]) expect(there[key]).toBeCloseTo(still[key], 9);
    expect(still.distanceMm ** 2).toBeCloseTo(still.alongMm ** 2 + still.acrossMm ** 2);
    const back = measured(second, first, new PlanFrame({ axisEntryMm: entry, axisDirection: direction }));
    expect(back.alongMm).toBeCloseTo(-still.alongMm);
    expect(back.distanceMm).toBeCloseTo(still.distanceMm);
  });

  it('begins anew with the third place', () => {
    expect(withPlace([], 'a')).toEqual(['a']);
    expect(withPlace(['a'], 'b')).toEqual(['a', 'b']);
    expect(withPlace(['a', 'b'], 'c')).toEqual(['c']);
  });
});
