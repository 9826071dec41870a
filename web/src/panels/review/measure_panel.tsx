import type { Pane, ReviewWorkspace } from './review_workspace';
import { PlanFrame } from '../../practice/plan_frame';
import { reviewText } from '../../text/review_text';
import { depthMm, measured } from '../../state/review/measuring';
import type { MeasuredPlace } from '../../state/review/review_session';
import { fixed } from '../../text/format';
import { Button } from '../common/button';

/** What was measured on each session, and how to. */
export function MeasurePanel({ workspace }: { workspace: ReviewWorkspace }) {
  const panes = workspace.panes.value;
  const measuring = workspace.settings.measuring.value;
  if (!measuring && panes.every(({ session }) => session.places.value.length === 0)) return null;
  return (
    <section class="review-panel" aria-labelledby="measure-title" data-testid="measure-panel">
      <h2 id="measure-title">{reviewText.measure}</h2>
      {panes.map((pane, i) => (
        <Measures
          key={pane.session.id + String(i)}
          pane={pane}
          number={panes.length > 1 ? i + 1 : null}
          measuring={measuring}
        />
      ))}
    </section>
  );
}

function Measures({ pane, number, measuring }: { pane: Pane; number: number | null; measuring: boolean }) {
  const { session } = pane;
  const places = session.places.value;
  const hello = session.store.hello.value;
  const step = session.missed.value
    ? reviewText.measureMissed
    : places.length === 0
      ? reviewText.measureFirst
      : places.length === 1
        ? reviewText.measureSecond
        : '';
  const rows = hello === null ? [] : rowsOf(places, new PlanFrame(hello));
  return (
    <div class="measures" data-testid="measures" aria-live="polite">
      {number !== null && <span class="pane-number">{number}</span>}
      {rows.length > 0 && (
        <dl>
          {rows.map(([name, value, hint]) => (
            <div key={name} title={hint}>
              <dt>{name}</dt>
              <dd>{value}</dd>
            </div>
          ))}
        </dl>
      )}
      {measuring && step !== '' && <p class="soft">{step}</p>}
      {places.length > 0 && (
        <Button testId="clear-measure" onClick={() => (session.places.value = [])}>
          {reviewText.measureClear}
        </Button>
      )}
    </div>
  );
}

type Row = readonly [name: string, value: string, hint?: string];

function rowsOf(places: readonly MeasuredPlace[], plan: PlanFrame): Row[] {
  const mm = (value: number) => reviewText.millimetres(fixed(value, 2));
  const [first, second] = places;
  const rows: Row[] = [];
  if (first !== undefined && second !== undefined) {
    const { distanceMm, alongMm, acrossMm } = measured(first.at, second.at, plan);
    rows.push([reviewText.distance, mm(distanceMm)]);
    rows.push([reviewText.deeper, mm(alongMm), reviewText.depthHint], [reviewText.across, mm(acrossMm)]);
  }
  places.forEach(({ at, deviation }, i) => {
    rows.push([reviewText.depthOf(i + 1), mm(depthMm(at, plan)), reviewText.depthHint]);
    if (deviation === null) return;
    const off = fixed(Math.abs(deviation.mm), 2);
    const side = deviation.to === 'wall' || deviation.mm === 0 ? 'even' : deviation.mm < 0 ? 'proud' : 'beyond';
    rows.push([reviewText.mapAt[deviation.to](i + 1), reviewText.deviationHere(off, side)]);
  });
  return rows;
}
