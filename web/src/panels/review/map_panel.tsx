import type { ReviewWorkspace } from './review_workspace';
import { reviewText } from '../../text/review_text';
import {
  deviationClasses,
  type DeviationClass,
  deviationShares,
  type ScaleName,
  scaleBoundsMm,
  unknownColour,
} from '../../state/review/deviation_scale';
import type { MapState } from '../../state/review/surface_map';
import { breachText } from '../../state/review/score_text';
import type { MapName } from '../../wire/review_api';
import { fixed } from '../../text/format';

const scales = Object.keys(scaleBoundsMm) as ScaleName[];

/** What the colours of the maps mean, and how much of each surface has which. */
export function MapPanel({ desk }: { desk: ReviewWorkspace }) {
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
        <h2 id="map-title">{reviewText.map}</h2>
        <label>
          {reviewText.scale}{' '}
          <select
            data-testid="map-scale"
            onChange={(event) => (settings.scale.value = event.currentTarget.value as ScaleName)}
          >
            {scales.map((name) => (
              <option key={name} value={name} selected={name === scale}>
                {reviewText.scaleName[name]}
              </option>
            ))}
          </select>
        </label>
      </div>
      {[...new Set<MapName>(wanted)].map((name) => (
        <p key={name} class="soft">
          <strong>{reviewText.mapName[name]}.</strong> {reviewText.mapCaption[name]}
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
                {each.hatched && <span class="visually-hidden"> {reviewText.hatched}</span>}
              </th>
              {ready.map((map, pane) => (
                <td key={pane} class="number" title={reviewText.shareHint}>
                  {map === null ? '' : reviewText.share(fixed((map.classes[all.length - 1 - i] ?? 0) * 100, 1))}
                </td>
              ))}
            </tr>
          ))}
          <tr>
            <th scope="row">
              <Swatch colour={unknownColour} hatched={false} />
              {reviewText.classUnknown}
            </th>
            {ready.map((_, pane) => (
              <td key={pane} />
            ))}
          </tr>
        </tbody>
      </table>
      {panes.map(({ session }, i) => {
        const { breached, words } = breachText(session.score.value.value);
        const map = ready[i];
        return (
          <div key={session.id + String(i)} class="map-facts">
            <p class={breached === true ? 'breach breach-bad' : 'breach'} data-testid={`breach-${i}`}>
              {panes.length > 1 && <span class="pane-number">{i + 1}</span>}
              <span aria-hidden="true">{breached === true ? '⬣ ' : breached === null ? '? ' : '● '}</span>
              <strong>{reviewText.breach}:</strong> {words}
            </p>
            {map !== null && map !== undefined && map.beyondRange > 0 && (
              <p class="soft">
                {reviewText.outOfRange(fixed(map.rangeMm, 1), fixed((map.beyondRange / map.known) * 100, 1))}
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
  if (side === 'even') return reviewText.classWithin(mm(toMm));
  return Number.isFinite(far) ? reviewText.classBetween(mm(near), mm(far), side) : reviewText.classOver(mm(near), side);
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
