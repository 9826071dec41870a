import { effect } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import UPlot from 'uplot';

import { FrameRequest } from '../../scene/frame_request';
import type { TraceColumn } from '../../state/live_trace';
import { plotSeconds, type Store } from '../../state/store';
import { theme } from '../../state/theme';

/** Of the browser's frames at least so many for each drawing, so that a slow computer keeps them for the picture. */
const framesEach = 3;
/** More are not told apart in the width of the panel. */
const maxPoints = 700;

/** How a column of the trace is drawn. */
export interface PlotKind {
  column: TraceColumn;
  unit: string;
  /** The axis reaches at least this far, so that it does not jump while the values rise. */
  axisAtLeast: number;
  /** And no further: what is beyond it says nothing of reaming. */
  axisAtMost: number;
  /** The axis ends at a multiple of this. */
  axisStep: number;
  /** To both sides of zero. */
  swings: boolean;
  axisDigits: number;
  /** Between two marks of the axis at least. */
  axisSpacePx: number;
}

interface Parts {
  store: Store;
  kind: PlotKind;
  label: string;
  testId: string;
}

/** One column of the session's trace over the last seconds of session time. */
export function TracePlot({ store, kind, label, testId }: Parts) {
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const element = place.current;
    if (element === null) return;
    return keepPlotted(element, store, kind);
  }, [store, kind]);
  return <div ref={place} class="plot" role="img" aria-label={label} data-testid={testId} />;
}

/** Draws the trace into `element` as it grows, and anew for another size or colour scheme, until the result is called. */
export function keepPlotted(element: HTMLElement, store: Store, kind: PlotKind): () => void {
  let plot = createPlot(element, kind);

  const redraw = () => {
    const { seconds, values } = store.trace.line(kind.column, plotSeconds, maxPoints);
    plot.setData([seconds, values]);
  };
  const drawing = new FrameRequest(redraw, framesEach);
  const recreate = () => {
    plot.destroy();
    plot = createPlot(element, kind);
    drawing.cancel();
    redraw();
  };
  const observer = new ResizeObserver(() => plot.setSize({ width: element.clientWidth, height: element.clientHeight }));
  observer.observe(element);
  let drawnIn = theme.shown.peek();
  const stopFollowingTheme = effect(() => {
    if (theme.shown.value === drawnIn) return;
    drawnIn = theme.shown.value;
    recreate();
  });
  const stopFollowing = effect(() => {
    if (store.traceRevision.value >= 0) drawing.request();
  });
  drawing.cancel();
  redraw();
  return () => {
    stopFollowing();
    drawing.dispose();
    observer.disconnect();
    stopFollowingTheme();
    plot.destroy();
  };
}

function createPlot(element: HTMLElement, kind: PlotKind): UPlot {
  const style = getComputedStyle(element);
  const colour = (name: string) => style.getPropertyValue(name).trim();
  const axis = {
    stroke: colour('--text-soft'),
    font: '12px system-ui, sans-serif',
    grid: { stroke: colour('--line'), width: 1 },
    ticks: { show: false },
  };
  const fill = kind.swings ? {} : { fill: colour('--force-fill') };
  return new UPlot(
    {
      width: element.clientWidth,
      height: element.clientHeight,
      padding: [8, 16, 0, 0],
      legend: { show: false },
      cursor: { show: false },
      scales: {
        x: { time: false, range: (plot) => rollingRange(plot.data[0].at(-1)) },
        y: { range: (_plot, least, most) => axisRange(kind, least, most) },
      },
      axes: [
        { ...axis, size: 26, values: (_plot, marks) => marks.map((mark) => `${mark} s`) },
        {
          ...axis,
          size: 46,
          space: kind.axisSpacePx,
          values: (_plot, marks) => marks.map((mark) => axisMark(kind, mark)),
        },
      ],
      series: [{}, { stroke: colour('--force'), ...fill, width: 1.75, points: { show: false } }],
    },
    [[], []],
    element,
  );
}

const axisMark = (kind: PlotKind, mark: number): string => `${mark.toFixed(kind.axisDigits)} ${kind.unit}`;

/** From zero, or as far below it as above. */
export function axisRange(kind: PlotKind, least: number, most: number): [number, number] {
  const reach = kind.swings ? Math.max(Math.abs(least), Math.abs(most)) : most;
  const wanted = Math.ceil((reach * 1.1) / kind.axisStep) * kind.axisStep;
  const end = Math.min(Math.max(kind.axisAtLeast, wanted), kind.axisAtMost);
  return [kind.swings ? -end : 0, end];
}

function rollingRange(newestSeconds: number | undefined): [number, number] {
  const end = Math.max(newestSeconds ?? 0, plotSeconds);
  return [end - plotSeconds, end];
}
