import { describe, expect, it } from 'vitest';

import { readTrace, traceStride } from '../../../src/state/review/session_trace';
import {
  eventsOfTrace,
  isEnd,
  mergedMarks,
  momentAt,
  neighbouringMark,
  shareOf,
  thrustLine,
} from '../../../src/state/review/timeline';

const trace = (thrustN: number[], spindleOn = thrustN.map(() => true)) => ({
  timesS: thrustN.map((_, i) => i),
  thrustN,
  spindleOn,
});

describe('trace of a session', () => {
  it('is read by the names of its columns', () => {
    const found = readTrace('t_s,other,spindle_on,thrust_n\n0,9,0,0.5\n0.2,9,1,12\nbroken\n');
    expect(found).toEqual({ timesS: [0, 0.2], thrustN: [0.5, 12], spindleOn: [false, true] });
    expect(() => readTrace('t_s,force\n0,1\n')).toThrow('thrust_n');
  });
  it('is asked for no finer than can be seen', () => {
    expect(traceStride(100)).toBe(1);
    for (const ticks of [601, 37_500, 3_600_000]) {
      expect(Math.ceil(ticks / traceStride(ticks))).toBeLessThanOrEqual(600);
      expect(Math.ceil(ticks / traceStride(ticks))).toBeGreaterThan(290);
    }
  });
});

describe('timeline', () => {
  it('finds presses, excess and the spindle', () => {
    const events = eventsOfTrace(
      trace(
        [0, 0, 5, 60, 90, 85, 60, 2, 1.5, 4, 0.5, 0],
        [false, true, true, true, true, true, true, true, true, true, true, false],
      ),
    );
    expect(events.map(({ kind, at_s }) => [kind, at_s])).toEqual([
      ['spindle-on', 1],
      ['contact', 2],
      ['excess', 4],
      ['withdrawn', 10],
      ['spindle-off', 11],
    ]);
  });

  it('takes what trembles for one event', () => {
    const timesS = Array.from({ length: 40 }, (_, i) => i * 0.05);
    const thrustN = timesS.map((_, i) => (i % 2 === 0 ? 0 : 10));
    const events = eventsOfTrace({ timesS, thrustN, spindleOn: timesS.map(() => false) });
    expect(events.map(({ kind }) => kind)).toEqual(['contact', 'withdrawn']);
  });

  it('puts marks in order and finds those around a moment', () => {
    const marks = mergedMarks(
      [{ at_s: 5, kind: 'annotation', words: 'look' }],
      eventsOfTrace(trace([0, 0, 5, 5, 5, 5, 0])),
    );
    expect(marks.map(({ at_s }) => at_s)).toEqual([0, 2, 5, 6]);
    expect(neighbouringMark(marks, 2, true)?.at_s).toBe(5);
    expect(neighbouringMark(marks, 2, false)?.at_s).toBe(0);
    expect(neighbouringMark(marks, 5.001, false)?.at_s).toBe(2);
    expect(neighbouringMark(marks, 6, true)).toBeNull();
    expect(neighbouringMark([], 3, false)).toBeNull();
  });

  it('leads from moments to places and back', () => {
    for (const moment of [0, 0.001, 12.345, 37.5]) expect(momentAt(shareOf(moment, 37.5), 37.5)).toBeCloseTo(moment, 6);
    expect(shareOf(50, 37.5)).toBe(1);
    expect(shareOf(-1, 37.5)).toBe(0);
    expect(shareOf(3, 0)).toBe(0);
    expect(momentAt(2, 10)).toBe(10);
  });

  it('knows the end, within a tick', () => {
    expect(isEnd(37_500, 37_500)).toBe(true);
    expect(isEnd(37_499, 37_500)).toBe(true);
    expect(isEnd(37_000, 37_500)).toBe(false);
    expect(isEnd(0, 0)).toBe(false);
  });

  it('draws thrust upwards within its picture', () => {
    const line = thrustLine(trace([0, 50, 200]), 2, 100, 40, 100);
    expect(line).toEqual([
      { x: 0, y: 40 },
      { x: 50, y: 20 },
      { x: 100, y: 0 },
    ]);
  });
});
