import { describe, expect, it } from 'vitest';

import { Lateness } from '../../src/state/lateness';

describe('Lateness', () => {
  it('is none while messages take as long as ever, whatever the clocks say', () => {
    const lateness = new Lateness();
    for (let at = 0; at < 3000; at += 33) expect(lateness.of(at, 1.7e12 + at + 5)).toBeCloseTo(0, 2);
  });

  it('grows with what waits on a slow link, and falls when that has come', () => {
    const lateness = new Lateness();
    lateness.of(0, 1.7e12);
    expect(lateness.of(1000, 1.7e12 + 3000)).toBeCloseTo(2000, -2);
    expect(lateness.of(3050, 1.7e12 + 3050)).toBeLessThan(5);
  });

  it('takes a first message that was late for late as soon as a quicker one has come', () => {
    const lateness = new Lateness();
    expect(lateness.of(0, 1.7e12 + 900)).toBe(0);
    expect(lateness.of(1000, 1.7e12 + 1000)).toBe(0);
    expect(lateness.of(1100, 1.7e12 + 2000)).toBeCloseTo(900, -1);
  });

  it('forgives clocks that drift apart', () => {
    const lateness = new Lateness();
    const driftPpm = 200;
    for (let at = 0; at < 3_600_000; at += 1000)
      expect(lateness.of(at, 1.7e12 + at * (1 + driftPpm * 1e-6))).toBeLessThan(2);
  });
});
