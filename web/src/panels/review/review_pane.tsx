import { useEffect, useRef } from 'preact/hooks';

import type { Pane, ReviewWorkspace } from './review_workspace';
import { reviewText } from '../../text/review_text';
import { addressOfRoute } from '../../state/route';
import type { ReviewSession } from '../../state/review/review_session';
import { appText } from '../../text/app_text';
import { fixed, percent } from '../../text/format';
import { lazyPart } from '../common/lazy_part';
import { LinkNotice } from '../live/link_notice';
import { PlaybackBar } from '../picture/playback_bar';
import { ProblemBanner } from '../common/problem_banner';
import { EventList } from './event_list';
import { MomentBar } from './moment_bar';
import { ThrustChart } from './thrust_chart';
import { Button } from '../common/button';

const slices = lazyPart(() => import('../picture/live_slices'));

interface Parts {
  pane: Pane;
  place: number;
  workspace: ReviewWorkspace;
}

/** One session: its picture, its timeline, and what of both is chosen. */
export function ReviewPane({ pane, place, workspace }: Parts) {
  const { session } = pane;
  const { settings } = workspace;
  const several = workspace.panes.value.length > 1;
  const active = several && settings.active.value === place;
  const take = () => (settings.active.value = place);
  return (
    <section
      class={active ? 'review-pane pane-active' : 'review-pane'}
      aria-label={several ? reviewText.pane(place + 1, session.id) : reviewText.session(session.id)}
      data-testid={`pane-${place}`}
      data-session={session.id}
      data-position={session.store.playback.value?.positionTicks ?? ''}
      onPointerDownCapture={take}
      onFocusCapture={take}
    >
      <div class="pane-head">
        {several && <PaneTitle place={place} workspace={workspace} />}
        <MomentBar session={session} />
        <EventList session={session} mayAnnotate={workspace.page.mayAnnotate} />
      </div>
      <PanePicture pane={pane} workspace={workspace} />
      <PlaybackBar store={session.store} player={session.player} marks={session.marks.value}>
        <ThrustChart session={session} />
      </PlaybackBar>
    </section>
  );
}

/** Which of two it is, and the way to the other alone. */
function PaneTitle({ place, workspace }: { place: number; workspace: ReviewWorkspace }) {
  const panes = workspace.panes.value;
  const session = panes[place]?.session;
  const other = panes[1 - place]?.session.id;
  if (session === undefined || other === undefined) return null;
  const details = session.details.value;
  return (
    <p class="pane-title">
      <span class="pane-number">{place + 1}</span>
      <span class="pane-name">
        {details?.title ? appText.titled(details.title) : details?.trainee || details?.participant || session.id}
      </span>
      <a
        class="close-pane"
        data-testid={`close-${place}`}
        aria-label={reviewText.closePane(session.id)}
        href={addressOfRoute({ kind: 'review', id: other, beside: null })}
      >
        {reviewText.close}
      </a>
    </p>
  );
}

function momentText({ store }: ReviewSession): string {
  const now = store.upToDate.value ? store.telemetry.value : null;
  const thrust = now?.thrustN.at(-1);
  return reviewText.momentStatus(fixed(now?.depthMm, 2), fixed(thrust, 1), fixed(now?.removedVolumeMm3, 0));
}

function PanePicture({ pane, workspace }: { pane: Pane; workspace: ReviewWorkspace }) {
  const { session, view, liveCase } = pane;
  const { store } = session;
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const { canvas } = view.scene;
    canvas.tabIndex = 0;
    canvas.dataset.testid = 'bone-canvas';
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', appText.sceneLabel);
    place.current?.prepend(canvas);
    return () => canvas.remove();
  }, [view]);
  const measuring = workspace.settings.measuring.value;
  const error = session.error.value;
  const stale = store.hasPicture.value && !store.upToDate.value;
  const map = session.map.state.value;
  const shown = session.mapShown.value;
  return (
    <div
      class={['picture review-picture', stale ? 'stale' : '', measuring ? 'measuring' : ''].join(' ')}
      data-testid="review-picture"
      data-stale={stale}
      data-map={shown?.name ?? 'none'}
    >
      <div class="canvas-place" ref={place} />
      {measuring && <span class="aim-cross" aria-hidden="true" />}
      <p class="chip moment-status" data-testid="moment-status">
        {momentText(session)}
      </p>
      {error === null ? (
        <LinkNotice store={store} mayReam={false} />
      ) : (
        <SessionErrorNotice session={session} served={workspace.page.served} />
      )}
      {store.recordingWarning.value !== null && (
        <p class="picture-note note-top" role="status" data-testid="recording-warning">
          {appText.recordingDamaged(store.recordingWarning.value)}
        </p>
      )}
      <ProblemBanner store={store} />
      {map.kind === 'making' && (
        <p class="picture-note" role="status" data-testid="map-making">
          {reviewText.mapMaking(percent(map.share))}
        </p>
      )}
      {map.kind === 'problem' && (
        <p class="picture-note note-bad" role="alert" data-testid="map-problem">
          {map.message}
        </p>
      )}
      {map.kind === 'ready' && shown === null && (
        <p class="picture-note" role="status" data-testid="map-at-end">
          {reviewText.mapAtEnd}{' '}
          <button type="button" class="link-button" onClick={() => session.showAfter()}>
            {reviewText.after}
          </button>
        </p>
      )}
      {liveCase !== null &&
        workspace.settings.slicesOpen.value &&
        slices.show(({ LiveSlicesPanel }) => <LiveSlicesPanel store={store} liveCase={liveCase} />)}
    </div>
  );
}

function SessionErrorNotice({ session, served }: { session: ReviewSession; served: boolean }) {
  const error = session.error.value;
  if (error === null) return null;
  const away = error.kind === 'live';
  return (
    <div class="notice notice-lost" role="alert" data-testid="session-error" data-kind={error.kind}>
      <p class="notice-title">{error.title}</p>
      <p>{error.text}</p>
      <p class="notice-actions">
        <Button onClick={() => session.tryAgain()}>{reviewText.tryAgain}</Button>
        {served && (
          <a href={addressOfRoute(away ? { kind: 'live' } : { kind: 'sessions' })}>
            {away ? reviewText.toLive : reviewText.toSessions}
          </a>
        )}
      </p>
    </div>
  );
}
