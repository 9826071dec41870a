import { Quaternion, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';

import { chipsMost, Debris, dropsMost, type Source } from '../../src/scene/debris';
import { profileOf } from '../../src/scene/tool_profile';
import type { ToolAction } from '../../src/state/tool_action';
import { libraryOutlines, revolved } from './library_tools';

const profile = profileOf(revolved(libraryOutlines['convex-30'] ?? []));
if (profile === null) throw new Error('no reamer');
const source: Source = { profile, at: new Vector3(100, -20, 40), turn: new Quaternion(0.5, 0.5, 0.5, 0.5) };

const action = (tick: number, removedMm3: number, changes: Partial<ToolAction> = {}): ToolAction => ({
  spindleRadS: 16,
  irrigating: false,
  removedMm3,
  tick,
  ...changes,
});

/** Reams for so long at so many mm³ a second; as many chips as were ever seen at once. */
function ream(debris: Debris, seconds: number, mm3PerS: number, changes: Partial<ToolAction> = {}): number {
  let most = 0;
  for (let ms = 0; ms <= seconds * 1000; ms += 16) {
    debris.follow(action(1000 + ms, (ms / 1000) * mm3PerS, changes), source);
    debris.step(0.016, source);
    most = Math.max(most, debris.particles.length);
  }
  return most;
}

/** Until nothing is seen any more, s. */
function goneAfterS(debris: Debris): number {
  let seconds = 0;
  while (debris.step(0.016, source) && seconds < 10) seconds += 0.016;
  return seconds;
}

describe('Debris', () => {
  it('is as much as the bone that is removed', () => {
    const seen = [10, 20, 40].map((mm3PerS) => ream(new Debris(), 3, mm3PerS));
    expect(seen[0]).toBeGreaterThan(5);
    for (const i of [1, 2]) expect((seen[i] ?? 0) / (seen[i - 1] ?? 1)).toBeCloseTo(2, 0);
    expect(ream(new Debris(), 3, 0)).toBe(0);
  });

  it('is few whatever happens', () => {
    const debris = new Debris();
    expect(ream(debris, 5, 5000, { irrigating: true })).toBeLessThanOrEqual(chipsMost + dropsMost);
    const jumped = new Debris();
    jumped.follow(action(1000, 0), source);
    jumped.follow(action(1015, 900), source);
    expect(jumped.particles.length).toBeLessThan(10);
  });

  it('begins at the head and ends within about a second after the last bone', () => {
    const debris = new Debris();
    debris.follow(action(1000, 0), source);
    debris.follow(action(1016, 4), source);
    expect(debris.particles.length).toBeGreaterThan(0);
    for (const { at } of debris.particles) expect(at.distanceTo(source.at)).toBeLessThan(profile.rimMm + 10);
    const seconds = goneAfterS(debris);
    expect(seconds).toBeGreaterThan(0.4);
    expect(seconds).toBeLessThan(1.2);
  });

  it('is washed away sooner, and drops are seen as long as water flows', () => {
    const wet = new Debris();
    ream(wet, 1, 40, { irrigating: true });
    expect(wet.particles.some(({ kind }) => kind === 'drop')).toBe(true);
    const dry = new Debris();
    ream(dry, 1, 40);
    const chips = (debris: Debris) => debris.particles.filter(({ kind }) => kind === 'chip').length;
    expect(chips(wet)).toBeLessThan(0.7 * chips(dry));
    expect(wet.step(0.016, source)).toBe(true);
    wet.follow(action(5000, 40), source);
    expect(goneAfterS(wet)).toBeLessThan(1.2);
  });

  it('is gone at once when the session rests', () => {
    const debris = new Debris();
    ream(debris, 1, 40, { irrigating: true });
    debris.follow(null, source);
    expect(debris.particles).toEqual([]);
    expect(debris.step(0.016, source)).toBe(false);
  });

  it('takes no jump of a recording for reaming', () => {
    for (const next of [action(9000, 500), action(500, 0), action(1000, 20), action(1016, 2)]) {
      const debris = new Debris();
      debris.follow(action(1000, 10), source);
      debris.follow(next, source);
      expect(debris.particles).toEqual([]);
    }
  });

  it('is the same each time', () => {
    const places = () => {
      const debris = new Debris();
      ream(debris, 2, 30, { irrigating: true });
      return debris.particles.map(({ at }) => at.toArray());
    };
    expect(places()).toEqual(places());
  });
});
