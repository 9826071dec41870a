import { dashboardText } from '../../text/dashboard_text';
import type { Tile } from '../../state/dashboard/live_board';
import { alarmsOf, type TileAlarm } from '../../state/dashboard/tile_alarms';
import { healthText } from '../../text/health_text';
import { appText } from '../../text/app_text';
import { clock, duration, fixed } from '../../text/format';
import { traineeLabel } from '../common/trainee_label';

/** One session under way: who, what the bone looks like, the figures that matter, and what is wrong. */
export function LiveTile({ tile, old, watch }: { tile: Tile; old: boolean; watch: (id: string) => void }) {
  const { session } = tile;
  const who = traineeLabel(session);
  const titleId = `tile-${session.id}`;
  return (
    <li
      class={old ? 'tile stale' : 'tile'}
      data-testid={`tile-${session.id}`}
      data-state={session.state}
      data-stale={old}
    >
      <Thumbnail tile={tile} />
      <div class="tile-text">
        <div class="tile-head">
          <h3 id={titleId}>
            <button
              type="button"
              class="tile-open"
              data-testid={`open-${session.id}`}
              aria-label={dashboardText.watchTile(who, session.case)}
              onClick={() => watch(session.id)}
            >
              {who}
            </button>
          </h3>
          <span class="chip" data-testid={`state-${session.id}`}>
            {old ? dashboardText.notLive : appText.state[session.state]}
          </span>
        </div>
        <p class="soft tile-what">
          {session.case}
          {session.attempt > 1 && `, ${dashboardText.attempt(session.attempt)}`}
          {session.theatre && `, ${dashboardText.theatre}`}
        </p>
        <Figures tile={tile} />
        <AlarmChips alarms={old ? [] : alarmsOf(tile)} />
      </div>
    </li>
  );
}

function Thumbnail({ tile: { picture, pictureMs } }: { tile: Tile }) {
  if (picture === null || pictureMs === null)
    return <p class="tile-picture tile-no-picture soft">{dashboardText.pictureComes}</p>;
  const label = dashboardText.pictureOf(clock(pictureMs));
  return (
    <figure class="tile-picture">
      <img src={picture} alt={label} width="1280" height="960" />
      <figcaption>{clock(pictureMs)}</figcaption>
    </figure>
  );
}

function Figures({ tile: { session, soFar, plannedDepthMm } }: { tile: Tile }) {
  const depth = fixed(soFar?.reaming_depth_mm, 2);
  return (
    <dl class="tile-figures">
      <Pair name={dashboardText.depth}>
        {plannedDepthMm === null
          ? dashboardText.depthAlone(depth)
          : dashboardText.depthOf(depth, fixed(plannedDepthMm, 1))}
      </Pair>
      <Pair name={dashboardText.thrust}>
        {dashboardText.newtons(fixed(soFar?.axial_thrust_mean_n, 0))}{' '}
        <span class="soft">
          {dashboardText.peak} {dashboardText.newtons(fixed(soFar?.axial_thrust_peak_n, 0))}
        </span>
      </Pair>
      <Pair name={dashboardText.removed}>{dashboardText.cubicMm(fixed(soFar?.removed_volume_mm3, 0))}</Pair>
      <Pair name={dashboardText.time}>{duration(soFar?.duration_s ?? session.duration_s)}</Pair>
    </dl>
  );
}

function Pair({ name, children }: { name: string; children: preact.ComponentChildren }) {
  return (
    <>
      <dt>{name}</dt>
      <dd>{children}</dd>
    </>
  );
}

/** Announced when they begin; their figures are only to be seen. */
function AlarmChips({ alarms }: { alarms: readonly TileAlarm[] }) {
  return (
    <div class="tile-alarms" role="status" aria-label={dashboardText.alarms}>
      {alarms.map((alarm) => (
        <p key={alarm.kind} class={`tile-alarm tile-alarm-${alarm.level}`} data-testid={`tile-alarm-${alarm.kind}`}>
          <svg viewBox="0 0 24 24" aria-hidden="true">
            {alarm.level === 'bad' ? (
              <path d="M7.5 1.5h9l6 6v9l-6 6h-9l-6-6v-9zM11 6v8h2V6zm0 10v2.4h2V16z" fill-rule="evenodd" />
            ) : (
              <path d="M12 1.8 23 21.5H1zM11 8.5v6.5h2V8.5zm0 8.2v2.3h2v-2.3z" fill-rule="evenodd" />
            )}
          </svg>
          {alarmText(alarm)}
        </p>
      ))}
    </div>
  );
}

function alarmText({ kind, value, message }: TileAlarm): string {
  switch (kind) {
    case 'fault':
      return message ?? appText.fault;
    case 'vault':
      return dashboardText.alarmVault(fixed(value, 1));
    case 'depth':
      return dashboardText.alarmDepth(fixed(value, 1));
    case 'thrust':
      return dashboardText.alarmThrust;
    case 'slow':
    case 'lost':
      return `${healthText.state[kind]}${message ? `. ${message}` : ''}`;
  }
}
