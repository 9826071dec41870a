import { describe, expect, it } from 'vitest';

import { LiveTrace } from '../../src/state/live_trace';

const thrust = (...values: number[]) => ({ thrustN: values });
const many = 100_000;

describe('LiveTrace', () => {
  it('keeps the newest entries, oldest first', () => {
    const trace = new LiveTrace(4);
    trace.append(0, 1, thrust(0, 1, 2));
    trace.append(3, 1, thrust(3, 4, 5));
    expect(trace.line('thrustN', 10, many)).toEqual({ seconds: [0.002, 0.003, 0.004, 0.005], values: [2, 3, 4, 5] });
    expect(trace.newest('thrustN')).toBe(5);
  });

  it('shows only the window', () => {
    const trace = new LiveTrace(100);
    trace.append(0, 500, thrust(1, 2, 3, 4, 5));
    expect(trace.line('thrustN', 1, many)).toEqual({ seconds: [1, 1.5, 2], values: [3, 4, 5] });
  });

  it('keeps a hole as a gap', () => {
    const trace = new LiveTrace(10);
    trace.append(0, 1, thrust(1, 2));
    trace.append(5, 1, thrust(6));
    expect(trace.line('thrustN', 1, many)).toEqual({ seconds: [0, 0.001, 0.002, 0.005], values: [1, 2, null, 6] });
  });

  it('leaves out what it has already', () => {
    const trace = new LiveTrace(10);
    trace.append(0, 1, thrust(1, 2, 3));
    trace.append(1, 1, thrust(20, 30, 4));
    expect(trace.line('thrustN', 1, many).values).toEqual([1, 2, 3, 4]);
  });

  it('begins anew when cleared', () => {
    const trace = new LiveTrace(10);
    trace.append(1000, 1, thrust(1));
    trace.clear();
    expect(trace.newest('thrustN')).toBeNull();
    trace.append(0, 1, thrust(7));
    expect(trace.line('thrustN', 1, many)).toEqual({ seconds: [0], values: [7] });
  });

  it('keeps columns beside each other, and says where one has nothing', () => {
    const trace = new LiveTrace(10);
    trace.append(0, 1, { thrustN: [1, 2], feedRateMmS: [0.1, 0.2] });
    expect(trace.line('feedRateMmS', 1, many).values).toEqual([0.1, 0.2]);
    expect(trace.newest('vibrationG')).toBeNull();
    expect(trace.line('vibrationG', 1, many).values).toEqual([null, null]);
  });

  it('draws few points and loses no peak of a single tick', () => {
    const trace = new LiveTrace(21_000);
    const values = Array.from({ length: 20_000 }, (_, i) => (i === 7123 ? 90 : i === 7124 ? -90 : Math.sin(i / 50)));
    trace.append(0, 1, thrust(...values));
    const line = trace.line('thrustN', 20, 400);
    expect(line.values.length).toBeLessThanOrEqual(402);
    const peak = line.values.indexOf(90);
    expect(line.seconds[peak]).toBe(7.123);
    expect(line.values).toContain(-90);
    for (let i = 1; i < line.seconds.length; ++i) expect(line.seconds[i]).toBeGreaterThan(line.seconds[i - 1] ?? 0);
    const before = line.values.slice(0, 300);
    trace.append(20_000, 1, thrust(0));
    expect(trace.line('thrustN', 20, 400).values.slice(0, 300)).toEqual(before);
  });

  it('has the strength of what swings', () => {
    const trace = new LiveTrace(2000);
    expect(trace.rms('vibrationG', 1)).toBeNull();
    const wave = Array.from({ length: 1000 }, (_, i) => 0.4 * Math.sin((2 * Math.PI * i) / 20));
    trace.append(0, 1, { vibrationG: [...wave.map(() => 5), ...wave] });
    expect(trace.rms('vibrationG', 1)).toBeCloseTo(0.4 / Math.SQRT2, 6);
  });
});
