import type { Signal } from '@preact/signals';

import type { Pane, ReviewWorkspace } from './review_workspace';
import { reviewText } from '../../text/review_text';
import {
  deviationClasses,
  type DeviationClass,
  deviationShares,
  type MapScale,
  type ScaleName,
  scaleOf,
  scaleBoundsMm,
  unknownColour,
} from '../../state/review/deviation_scale';
import type { MapState } from '../../state/review/surface_map';
import { breachText } from '../../state/review/score_text';
import { type MapName, mapNames } from '../../wire/review_api';
import { fixed } from '../../text/format';

const scales = Object.keys(scaleBoundsMm) as ScaleName[];

/** What the colours of the maps mean, and how much of each surface has which. */
export function MapPanel({ workspace }: { workspace: ReviewWorkspace }) {
  const panes = workspace.panes.value;
  const wanted = panes.flatMap(({ session }) => wantedMap(session.map.state.value) ?? []);
  if (wanted.length === 0) return null;
  const scale = workspace.settings.scale.value;
  const maps = panes.map(({ session }) => readyMap(session.map.state.value, scale));
  return (
    <section class="review-panel map-panel" aria-labelledby="map-title" data-testid="map-panel">
      <div class="panel-head">
        <h2 id="map-title">{reviewText.map}</h2>
        <ScaleChoice scale={workspace.settings.scale} />
      </div>
      {mapNames
        .filter((name) => wanted.includes(name))
        .map((name) => (
          <p key={name} class="soft">
            <strong>{reviewText.mapName[name]}.</strong> {reviewText.mapCaption[name]}
          </p>
        ))}
      {[...new Set(wanted.map((name) => scaleOf(name, scale)))].map((each) => (
        <Legend key={each} scale={each} maps={maps.map((map) => (map?.scale === each ? map : null))} />
      ))}
      {panes.map((pane, i) => (
        <SurfaceFacts key={pane.session.id + String(i)} pane={pane} map={maps[i] ?? null} place={i} of={panes.length} />
      ))}
    </section>
  );
}

function ScaleChoice({ scale }: { scale: Signal<ScaleName> }) {
  return (
    <label>
      {reviewText.scale}{' '}
      <select data-testid="map-scale" onChange={(event) => (scale.value = event.currentTarget.value as ScaleName)}>
        {scales.map((name) => (
          <option key={name} value={name} selected={name === scale.value}>
            {reviewText.scaleName[name]}
          </option>
        ))}
      </select>
    </label>
  );
}

const wantedMap = (state: MapState): MapName | null =>
  state.kind === 'making' || state.kind === 'ready' ? state.name : null;

type ReadyMap = ReturnType<typeof readyMap>;

/** The classes of deviation from the proudest down, of a wall from the thickest down, and the share of each surface that lies in them. */
function Legend({ scale, maps }: { scale: MapScale; maps: readonly ReadyMap[] }) {
  return (
    <table class="legend" data-testid="legend">
      {maps.length > 1 && (
        <thead>
          <tr>
            <td />
            {maps.map((_, i) => (
              <th key={i} scope="col">
                <span class="pane-number">{i + 1}</span>
              </th>
            ))}
          </tr>
        </thead>
      )}
      <tbody>
        {[...deviationClasses(scale)].reverse().map((each, i, all) => (
          <ClassRow key={i} of={each} shares={maps.map((map) => map && (map.classes[all.length - 1 - i] ?? 0))} />
        ))}
        <tr>
          <th scope="row">
            <Swatch colour={unknownColour} hatched={false} />
            {reviewText.classUnknown}
          </th>
          {maps.map((_, pane) => (
            <td key={pane} />
          ))}
        </tr>
      </tbody>
    </table>
  );
}

function ClassRow({ of, shares }: { of: DeviationClass; shares: readonly (number | null)[] }) {
  return (
    <tr>
      <th scope="row">
        <Swatch colour={of.colour} hatched={of.hatched} />
        {classText(of)}
        {of.hatched && <span class="visually-hidden"> {reviewText.hatched}</span>}
      </th>
      {shares.map((share, pane) => (
        <td key={pane} class="number" title={reviewText.shareHint}>
          {share === null ? '' : reviewText.share(fixed(share * 100, 1))}
        </td>
      ))}
    </tr>
  );
}

/** Of one surface: whether pegs would breach the vault, and what is beyond the map's range. */
function SurfaceFacts({ pane, map, place, of }: { pane: Pane; map: ReadyMap; place: number; of: number }) {
  const { breached, message } = breachText(pane.session.score.value.value);
  return (
    <div class="map-facts">
      <p class={breached === true ? 'breach breach-bad' : 'breach'} data-testid={`breach-${place}`}>
        {of > 1 && <span class="pane-number">{place + 1}</span>}
        <span aria-hidden="true">{breached === true ? '⬣ ' : breached === null ? '? ' : '● '}</span>
        <strong>{reviewText.breach}:</strong> {message}
      </p>
      {map !== null && map.beyondRange > 0 && (
        <p class="soft">
          {reviewText.outOfRange(fixed(map.rangeMm, 1), fixed((map.beyondRange / map.known) * 100, 1))}
        </p>
      )}
    </div>
  );
}

function readyMap(state: MapState, chosen: ScaleName) {
  if (state.kind !== 'ready') return null;
  const scale = scaleOf(state.name, chosen);
  const { bytes, code } = state.deviation;
  return { ...deviationShares(bytes, scale, code), scale, rangeMm: code.rangeMm };
}

function classText({ fromMm, toMm, side }: DeviationClass): string {
  if (side === 'wall') return reviewText.classWall(fromMm, toMm);
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
