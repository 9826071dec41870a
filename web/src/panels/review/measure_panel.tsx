import type { Pane, ReviewDesk } from '../../pages/review_desk';
import { PlanFrame } from '../../practice/plan_frame';
import { reviewWords } from '../../review_words';
import { depthMm, measured } from '../../state/review/measuring';
import type { MeasuredPlace } from '../../state/review/review_session';
import { fixed } from '../format';

/** What was measured on each session, and how to. */
export function MeasurePanel({ desk }: { desk: ReviewDesk }) {
  const panes = desk.panes.value;
  const measuring = desk.settings.measuring.value;
  if (!measuring && panes.every(({ session }) => session.places.value.length === 0)) return null;
  return (
    <section class="review-panel" aria-labelledby="measure-title" data-testid="measure-panel">
      <h2 id="measure-title">{reviewWords.measure}</h2>
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
    ? reviewWords.measureMissed
    : places.length === 0
      ? reviewWords.measureFirst
      : places.length === 1
        ? reviewWords.measureSecond
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
        <button
          type="button"
          class="plain-button"
          data-testid="clear-measure"
          onClick={() => (session.places.value = [])}
        >
          {reviewWords.measureClear}
        </button>
      )}
    </div>
  );
}

type Row = readonly [name: string, value: string, hint?: string];

function rowsOf(places: readonly MeasuredPlace[], plan: PlanFrame): Row[] {
  const mm = (value: number) => reviewWords.millimetres(fixed(value, 2));
  const [first, second] = places;
  const rows: Row[] = [];
  if (first !== undefined && second !== undefined) {
    const { distanceMm, alongMm, acrossMm } = measured(first.at, second.at, plan);
    rows.push([reviewWords.distance, mm(distanceMm)]);
    rows.push([reviewWords.deeper, mm(alongMm), reviewWords.depthHint], [reviewWords.across, mm(acrossMm)]);
  }
  places.forEach(({ at, deviation }, i) => {
    rows.push([reviewWords.depthOf(i + 1), mm(depthMm(at, plan)), reviewWords.depthHint]);
    if (deviation === null) return;
    const off = fixed(Math.abs(deviation.mm), 2);
    const side = deviation.mm === 0 ? 'even' : deviation.mm < 0 ? 'proud' : 'beyond';
    rows.push([reviewWords.mapAt[deviation.to](i + 1), reviewWords.deviationHere(off, side)]);
  });
  return rows;
}
