import type { ReviewDesk } from '../../pages/review_desk';
import { reviewWords } from '../../review_words';
import {
  deviationClasses,
  type DeviationClass,
  deviationShares,
  type ScaleName,
  scaleBoundsMm,
  unknownColour,
} from '../../state/review/deviation_scale';
import type { MapState } from '../../state/review/surface_map';
import { breachWords } from '../../state/review/score_words';
import type { MapName } from '../../wire/review_api';
import { fixed } from '../format';

const scales = Object.keys(scaleBoundsMm) as ScaleName[];

/** What the colours of the maps mean, and how much of each surface has which. */
export function MapPanel({ desk }: { desk: ReviewDesk }) {
  const { settings } = desk;
  const panes = desk.panes.value;
  const wanted = panes
    .map(({ session }) => session.map.state.value)
    .flatMap((state) => (state.kind === 'making' || state.kind === 'ready' ? [state.name] : []));
  if (wanted.length === 0) return null;
  const scale = settings.scale.value;
  const ready = panes.map(({ session }) => readyMap(session.map.state.value, scale));
  return (
    <section class="review-panel map-panel" aria-labelledby="map-title" data-testid="map-panel">
      <div class="panel-head">
        <h2 id="map-title">{reviewWords.map}</h2>
        <label>
          {reviewWords.scale}{' '}
          <select
            data-testid="map-scale"
            onChange={(event) => (settings.scale.value = event.currentTarget.value as ScaleName)}
          >
            {scales.map((name) => (
              <option key={name} value={name} selected={name === scale}>
                {reviewWords.scaleName[name]}
              </option>
            ))}
          </select>
        </label>
      </div>
      {[...new Set<MapName>(wanted)].map((name) => (
        <p key={name} class="soft">
          <strong>{reviewWords.mapName[name]}.</strong> {reviewWords.mapCaption[name]}
        </p>
      ))}
      <table class="legend" data-testid="legend">
        {panes.length > 1 && (
          <thead>
            <tr>
              <td />
              {panes.map((_, i) => (
                <th key={i} scope="col">
                  <span class="pane-number">{i + 1}</span>
                </th>
              ))}
            </tr>
          </thead>
        )}
        <tbody>
          {[...deviationClasses(scale)].reverse().map((each, i, all) => (
            <tr key={i}>
              <th scope="row">
                <Swatch colour={each.colour} hatched={each.hatched} />
                {classWords(each)}
                {each.hatched && <span class="visually-hidden"> {reviewWords.hatched}</span>}
              </th>
              {ready.map((map, pane) => (
                <td key={pane} class="number" title={reviewWords.shareHint}>
                  {map === null ? '' : reviewWords.share(fixed((map.classes[all.length - 1 - i] ?? 0) * 100, 1))}
                </td>
              ))}
            </tr>
          ))}
          <tr>
            <th scope="row">
              <Swatch colour={unknownColour} hatched={false} />
              {reviewWords.classUnknown}
            </th>
            {ready.map((_, pane) => (
              <td key={pane} />
            ))}
          </tr>
        </tbody>
      </table>
      {panes.map(({ session }, i) => {
        const { breached, words } = breachWords(session.score.value.value);
        const map = ready[i];
        return (
          <div key={session.id + String(i)} class="map-facts">
            <p class={breached === true ? 'breach breach-bad' : 'breach'} data-testid={`breach-${i}`}>
              {panes.length > 1 && <span class="pane-number">{i + 1}</span>}
              <span aria-hidden="true">{breached === true ? '⬣ ' : breached === null ? '? ' : '● '}</span>
              <strong>{reviewWords.breach}:</strong> {words}
            </p>
            {map !== null && map !== undefined && map.beyondRange > 0 && (
              <p class="soft">
                {reviewWords.outOfRange(fixed(map.rangeMm, 1), fixed((map.beyondRange / map.known) * 100, 1))}
              </p>
            )}
          </div>
        );
      })}
    </section>
  );
}

function readyMap(state: MapState, scale: ScaleName) {
  if (state.kind !== 'ready') return null;
  const { bytes, code } = state.deviation;
  return { ...deviationShares(bytes, scale, code), rangeMm: code.rangeMm };
}

function classWords({ fromMm, toMm, side }: DeviationClass): string {
  const [near, far] = side === 'proud' ? [-toMm, -fromMm] : [fromMm, toMm];
  const mm = (value: number) => String(value);
  if (side === 'even') return reviewWords.classWithin(mm(toMm));
  return Number.isFinite(far)
    ? reviewWords.classBetween(mm(near), mm(far), side)
    : reviewWords.classOver(mm(near), side);
}

function Swatch({ colour, hatched }: { colour: readonly number[]; hatched: boolean }) {
  return (
    <span
      class={hatched ? 'swatch swatch-hatched' : 'swatch'}
      style={{ backgroundColor: `rgb(${colour.join(' ')})` }}
      aria-hidden="true"
    />
  );
}
