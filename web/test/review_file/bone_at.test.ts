import { describe, expect, it } from 'vitest';

import { BoneAt } from '../../src/review_file/bone_at';
import type { Outcome } from '../../src/twin/twin_module';

const start = Uint8Array.of(1);
const density = Uint8Array.of(5);
const segment = Uint8Array.of(2);
const end = Uint8Array.of(4);

/** 250 ticks from there on, as proto/causes.md lays them out. */
function ticks(first: number): Uint8Array {
  const part = new Uint8Array(17);
  part[0] = 3;
  const view = new DataView(part.buffer);
  view.setUint32(1, first, true);
  view.setUint32(5, 250, true);
  return part;
}

/** Follows the rules of TwinPlayer: ticks come in order, moments are counted as they are passed. */
class StrictTwin {
  readonly moments: number[] = [];
  ticks = 0;
  taken = 0;
  startIs: Outcome = 'agrees';
  private passed = 0;

  constructor(private readonly differsAt = Infinity) {}

  take(part: Uint8Array): Outcome {
    ++this.taken;
    if (part[0] === 1) return this.startIs;
    if (part[0] !== 3) return 'agrees';
    if (new DataView(part.buffer).getUint32(1, true) !== this.ticks) return 'damaged';
    if (this.ticks + 250 > this.differsAt) return 'differs';
    this.ticks += 250;
    return 'agrees';
  }
  keepSnapshot(): number {
    if (this.passed === this.moments.length) this.moments.push(this.ticks);
    else expect(this.moments[this.passed], 'it is the moment that was kept').toBe(this.ticks);
    return this.passed++;
  }
  goTo(moment: number): boolean {
    const there = this.moments[moment];
    if (there === undefined) return false;
    this.ticks = there;
    this.passed = moment + 1;
    return true;
  }
}

const minute = [start, density, segment, ...Array.from({ length: 240 }, (_, i) => ticks(i * 250)), end];

describe('The bone of a review file', () => {
  it('is that of the last quarter of a second at any moment, forwards and backwards', () => {
    const twin = new StrictTwin();
    const bone = new BoneAt(twin, minute);
    let random = 4711;
    for (let round = 0; round < 200; ++round) {
      random = (random * 48271) % 2147483647;
      const wanted = random % 60_001;
      expect(bone.goTowards(wanted, 1e9)).toBe(true);
      expect(bone.ticks).toBe(wanted - (wanted % 250));
      expect(twin.ticks).toBe(bone.ticks);
    }
    expect(bone.limitTicks).toBe(Infinity);
    expect(twin.moments.length).toBeGreaterThan(4);
  });

  it('is computed ahead while nothing else is asked for', () => {
    const twin = new StrictTwin();
    const bone = new BoneAt(twin, minute);
    bone.goTowards(7100, 1e9);
    let turns = 0;
    let now = 0;
    while (bone.lookAhead(10, () => ++now)) {
      ++turns;
      if (turns % 5 === 0) {
        bone.goTowards(7100, 1e9);
        expect(bone.ticks).toBe(7000);
      }
    }
    expect(turns).toBeGreaterThan(5);
    const before = twin.taken;
    bone.goTowards(60_000, 1e9);
    bone.goTowards(31_000, 1e9);
    expect(twin.taken - before, 'moments are near').toBeLessThan(25);
    expect(bone.lookAhead(10)).toBe(false);
  });

  it('goes back without computing all of it again', () => {
    const twin = new StrictTwin();
    const bone = new BoneAt(twin, minute);
    bone.goTowards(60_000, 1e9);
    const before = twin.taken;
    bone.goTowards(59_000, 1e9);
    bone.goTowards(60_000, 1e9);
    expect(twin.taken - before).toBeLessThan(40);
  });

  it('says that it is on its way when its time is over', () => {
    const bone = new BoneAt(new StrictTwin(), minute);
    let now = 0;
    expect(bone.goTowards(60_000, 10, () => ++now)).toBe(false);
    expect(bone.ticks).toBeGreaterThan(0);
    expect(bone.ticks).toBeLessThan(60_000);
  });

  it('ends at the last snapshot before causes that contradict themselves', () => {
    const twin = new StrictTwin(31_250);
    const bone = new BoneAt(twin, minute);
    expect(bone.goTowards(60_000, 1e9)).toBe(true);
    expect([bone.limitTicks, bone.ticks, twin.ticks]).toEqual([30_000, 30_000, 30_000]);
    expect(bone.goTowards(5000, 1e9)).toBe(true);
    expect(bone.ticks).toBe(5000);
    expect(bone.goTowards(60_000, 1e9)).toBe(true);
    expect(bone.ticks).toBe(30_000);
    expect(bone.lookAhead(1e9)).toBe(false);
  });

  it('needs a bone to begin with', () => {
    const twin = new StrictTwin();
    twin.startIs = 'damaged';
    expect(() => new BoneAt(twin, minute)).toThrow('do not begin with a bone');
  });
});
