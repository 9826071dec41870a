import { effect } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import UPlot from 'uplot';

import { plotSeconds, type Store } from '../state/store';
import { theme } from '../state/theme';
import { words } from '../words';
import { fixed } from './format';

/** Redrawn at most this often; the eye reads no more from a rolling line. */
const redrawMs = 50;
/** The force axis reaches at least this far, so that it does not jump while the force rises. */
const axisAtLeastN = 60;

/** Axial thrust over the last seconds of session time. */
export function ForcePlot({ store }: { store: Store }) {
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const element = place.current;
    if (element === null) return;
    return keepPlotted(element, store);
  }, [store]);

  const newest = store.traceRevision.value >= 0 ? store.trace.newest() : null;
  const shown = newest === null ? words.none : fixed(newest, 1);
  return (
    <section class="force" aria-labelledby="force-title">
      <div class="force-head">
        <h2 id="force-title">{words.thrust}</h2>
        <p class="force-now">
          <span data-testid="thrust" class="big">
            {shown}
          </span>{' '}
          N
          {newest !== null && !store.live.value && (
            <span class="not-live"> {store.upToDate.value ? words.replayed : words.notLive}</span>
          )}
        </p>
      </div>
      <div
        ref={place}
        class="plot"
        role="img"
        aria-label={`${words.thrustPlot}, ${words.thrustNow(shown)}`}
        data-testid="force-plot"
      />
    </section>
  );
}

/** Draws the trace into `element` as it grows, and anew for another size or colour scheme, until the result is called. */
function keepPlotted(element: HTMLElement, store: Store): () => void {
  let plot = createPlot(element);
  let timer: ReturnType<typeof setTimeout> | undefined;

  const redraw = () => {
    timer = undefined;
    const { seconds, values } = store.trace.window(plotSeconds);
    plot.setData([seconds, values]);
  };
  const recreate = () => {
    plot.destroy();
    plot = createPlot(element);
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
    if (store.traceRevision.value >= 0 && timer === undefined) timer = setTimeout(redraw, redrawMs);
  });
  redraw();
  return () => {
    stopFollowing();
    clearTimeout(timer);
    observer.disconnect();
    stopFollowingTheme();
    plot.destroy();
  };
}

function createPlot(element: HTMLElement): UPlot {
  const style = getComputedStyle(element);
  const colour = (name: string) => style.getPropertyValue(name).trim();
  const axis = {
    stroke: colour('--text-soft'),
    font: '12px system-ui, sans-serif',
    grid: { stroke: colour('--line'), width: 1 },
    ticks: { show: false },
  };
  return new UPlot(
    {
      width: element.clientWidth,
      height: element.clientHeight,
      padding: [8, 16, 0, 0],
      legend: { show: false },
      cursor: { show: false },
      scales: {
        x: { time: false, range: (plot) => rollingRange(plot.data[0].at(-1)) },
        y: { range: (_plot, _least, most) => [0, Math.max(axisAtLeastN, Math.ceil((most * 1.1) / 20) * 20)] },
      },
      axes: [
        { ...axis, size: 26, values: (_plot, marks) => marks.map((mark) => `${mark} s`) },
        { ...axis, size: 46, values: (_plot, marks) => marks.map((mark) => `${mark} N`) },
      ],
      series: [{}, { stroke: colour('--force'), fill: colour('--force-fill'), width: 1.75, points: { show: false } }],
    },
    [[], []],
    element,
  );
}

function rollingRange(newestSeconds: number | undefined): [number, number] {
  const end = Math.max(newestSeconds ?? 0, plotSeconds);
  return [end - plotSeconds, end];
}
