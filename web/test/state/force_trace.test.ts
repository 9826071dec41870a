import { describe, expect, it } from 'vitest';

import { ForceTrace } from '../../src/state/force_trace';

describe('ForceTrace', () => {
  it('keeps the newest entries, oldest first', () => {
    const trace = new ForceTrace(4);
    trace.append(0, 1, [0, 1, 2]);
    trace.append(3, 1, [3, 4, 5]);
    expect(trace.window(10)).toEqual({ seconds: [0.002, 0.003, 0.004, 0.005], values: [2, 3, 4, 5] });
    expect(trace.newest()).toBe(5);
  });

  it('shows only the window', () => {
    const trace = new ForceTrace(100);
    trace.append(0, 500, [1, 2, 3, 4, 5]);
    expect(trace.window(1)).toEqual({ seconds: [1, 1.5, 2], values: [3, 4, 5] });
  });

  it('keeps a hole as a gap', () => {
    const trace = new ForceTrace(10);
    trace.append(0, 1, [1, 2]);
    trace.append(5, 1, [6]);
    expect(trace.window(1)).toEqual({ seconds: [0, 0.001, 0.002, 0.005], values: [1, 2, null, 6] });
  });

  it('leaves out what it has already', () => {
    const trace = new ForceTrace(10);
    trace.append(0, 1, [1, 2, 3]);
    trace.append(1, 1, [20, 30, 4]);
    expect(trace.window(1).values).toEqual([1, 2, 3, 4]);
  });

  it('begins anew when cleared', () => {
    const trace = new ForceTrace(10);
    trace.append(1000, 1, [1]);
    trace.clear();
    expect(trace.newest()).toBeNull();
    trace.append(0, 1, [7]);
    expect(trace.window(1)).toEqual({ seconds: [0], values: [7] });
  });
});
