import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { axisRange, keepPlotted, type PlotKind } from '../../../src/panels/picture/trace_plot';
import { Store } from '../../../src/state/store';
import { theme } from '../../../src/state/theme';

/** What is asked of the plotting library, which wants a browser. */
const plots = vi.hoisted(() => ({ living: 0, drawings: 0, drawingsAfterTheEnd: 0 }));
vi.mock('uplot', () => ({
  default: class {
    private destroyed = false;
    constructor() {
      ++plots.living;
    }
    setData() {
      ++plots.drawings;
      if (this.destroyed) ++plots.drawingsAfterTheEnd;
    }
    destroy() {
      this.destroyed = true;
      --plots.living;
    }
  },
}));

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

describe('a plotted trace', () => {
  let frames: Map<number, FrameRequestCallback>;
  beforeEach(() => {
    frames = new Map();
    let frame = 0;
    vi.stubGlobal('requestAnimationFrame', (draw: FrameRequestCallback) => {
      frames.set(++frame, draw);
      return frame;
    });
    vi.stubGlobal('cancelAnimationFrame', (requests: number) => frames.delete(requests));
    vi.stubGlobal('getComputedStyle', () => ({ getPropertyValue: () => '' }));
    vi.stubGlobal(
      'ResizeObserver',
      class {
        observe() {}
        disconnect() {}
      },
    );
    Object.assign(plots, { living: 0, drawings: 0, drawingsAfterTheEnd: 0 });
    theme.choice.value = 'light';
  });
  afterEach(() => vi.unstubAllGlobals());

  /** All the browser's frames until none is asked for; in each, what was asked for before it. */
  function passFrames(): void {
    while (frames.size > 0) {
      const now = [...frames.values()];
      frames.clear();
      for (const draw of now) draw(0);
    }
  }
  const plotted = (store: Store) => keepPlotted({ clientWidth: 100, clientHeight: 50 } as HTMLElement, store, feed);

  it('is drawn as it grows, once for all that comes within a few frames', () => {
    const store = new Store();
    const stop = plotted(store);
    passFrames();
    const before = plots.drawings;
    ++store.traceRevision.value;
    ++store.traceRevision.value;
    expect(frames.size).toBe(1);
    passFrames();
    expect(plots.drawings).toBe(before + 1);
    stop();
  });

  it('is not drawn any more once it is taken away, not even in another colour scheme', () => {
    const store = new Store();
    const stop = plotted(store);
    ++store.traceRevision.value;
    theme.choice.value = 'dark';
    ++store.traceRevision.value;
    expect(frames.size).toBe(1);
    stop();
    passFrames();
    expect(plots).toMatchObject({ living: 0, drawingsAfterTheEnd: 0 });
  });
});
