import { describe, expect, it } from 'vitest';

import { axisRange, type PlotKind } from '../../src/panels/trace_plot';

const feed: PlotKind = {
  column: 'feedRateMmS',
  unit: '',
  axisAtLeast: 0.2,
  axisAtMost: 1,
  axisStep: 0.2,
  swings: false,
  axisDigits: 1,
  axisSpacePx: 14,
};

describe('axisRange', () => {
  it('has room for what is drawn, and does not jump while there is little', () => {
    expect(axisRange(feed, 0, 0.05)).toEqual([0, 0.2]);
    expect(axisRange(feed, 0, 0.5)[1]).toBeCloseTo(0.6, 9);
  });

  it('does not follow a reamer that is drawn back in air', () => {
    expect(axisRange(feed, 0, 40)).toEqual([0, 1]);
  });

  it('reaches to both sides of what swings', () => {
    expect(axisRange({ ...feed, swings: true, axisAtMost: 10, axisStep: 1 }, -2.5, 0.1)).toEqual([-3, 3]);
  });
});
