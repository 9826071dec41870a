import type { Store } from '../../state/store';
import { appText } from '../../text/app_text';
import { fixed } from '../../text/format';
import { type PlotKind, TracePlot } from '../picture/trace_plot';

const thrust: PlotKind = {
  column: 'thrustN',
  unit: 'N',
  axisAtLeast: 60,
  axisAtMost: Infinity,
  axisStep: 20,
  swings: false,
  axisDigits: 0,
  axisSpacePx: 28,
};
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
const vibration: PlotKind = {
  column: 'vibrationG',
  unit: '',
  axisAtLeast: 1,
  axisAtMost: 10,
  axisStep: 0.5,
  swings: true,
  axisDigits: 1,
  axisSpacePx: 14,
};
/** The strength of a vibration is that of its last tenth of a second. */
const strengthSeconds = 0.1;

/** What the hand's work came to, tick by tick, over the last seconds of session time: thrust, feed and vibration. */
export function ForcePlots({ store }: { store: Store }) {
  const known = store.reading.value.traceRevision >= 0 && store.moving.value;
  const newest = known ? store.trace.newest('thrustN') : null;
  const shown = newest === null ? appText.none : fixed(newest, 1);
  return (
    <section class="force" aria-labelledby="force-title">
      <div class="force-head">
        <h2 id="force-title">{appText.thrust}</h2>
        <p class="force-now">
          <span data-testid="thrust" class="big">
            {shown}
          </span>{' '}
          N
          {newest !== null && !store.live.value && (
            <span class="not-live"> {store.upToDate.value ? appText.replayed : appText.notLive}</span>
          )}
        </p>
      </div>
      <TracePlot
        store={store}
        kind={thrust}
        label={`${appText.thrustPlot}, ${appText.thrustNow(shown)}`}
        testId="force-plot"
      />
      <div class="lesser-plots">
        <LesserPlot
          store={store}
          kind={feed}
          title={appText.feed}
          now={known ? store.trace.newest('feedRateMmS') : null}
          digits={2}
          unit="mm/s"
          label={appText.feedPlot}
          testId="feed-plot"
        />
        <LesserPlot
          store={store}
          kind={vibration}
          title={appText.vibration}
          now={known ? store.trace.rms('vibrationG', strengthSeconds) : null}
          digits={2}
          unit={appText.gRms}
          label={appText.vibrationPlot}
          testId="vibration-plot"
        />
      </div>
    </section>
  );
}

interface LesserParts {
  store: Store;
  kind: PlotKind;
  title: string;
  now: number | null;
  digits: number;
  unit: string;
  label: string;
  testId: string;
}

function LesserPlot({ store, kind, title, now, digits, unit, label, testId }: LesserParts) {
  const shown = fixed(now, digits);
  return (
    <div class="lesser-plot">
      <p class="lesser-head">
        <span>{title}</span>{' '}
        <span>
          <strong data-testid={`${testId}-now`}>{shown}</strong> <span class="soft">{unit}</span>
        </span>
      </p>
      <TracePlot store={store} kind={kind} label={`${label}, ${appText.nowIs(shown, unit)}`} testId={testId} />
    </div>
  );
}
