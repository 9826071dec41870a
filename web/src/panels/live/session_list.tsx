import { canBeReplayed, isActive } from '../../state/choose_session';
import { addressOfRoute } from '../../state/route';
import type { Store } from '../../state/store';
import type { Watcher } from '../../state/watcher';
import type { Session } from '../../wire/rest_types';
import { appText } from '../../text/app_text';
import { dayAndTime, duration } from '../../text/format';
import { useIdentity } from '../common/site_nav';

/** Earlier sessions, newest first; those that have ended can be replayed. */
export function SessionList({ store, watcher }: { store: Store; watcher: Watcher }) {
  const may = useIdentity().may.value;
  const sessions = store.sessions.value.filter((session) => session.state !== 'created');
  return (
    <details class="sessions" data-testid="sessions">
      <summary>{appText.sessions(sessions.length)}</summary>
      {sessions.length === 0 && <p class="soft">{appText.noSessions}</p>}
      {may.ream && (
        <a class="all-sessions" href={addressOfRoute({ kind: 'sessions' })} data-testid="all-sessions">
          {appText.allSessions}
        </a>
      )}
      <ul>
        {sessions.map((session) => (
          <Row key={session.id} session={session} store={store} watcher={watcher} />
        ))}
      </ul>
    </details>
  );
}

function Row({ session, store, watcher }: RowParts) {
  return (
    <li data-testid={`session-${session.id}`} data-state={session.state}>
      <When session={session} />
      <span>
        {session.trainee || session.case} <span class="soft">{duration(session.duration_s)}</span>
      </span>
      <span class={`session-word session-${session.state}`}>{appText.state[session.state]}</span>
      {isActive(session) ? (
        <WatchButton session={session} store={store} watcher={watcher} />
      ) : (
        <ReplayButton session={session} store={store} watcher={watcher} />
      )}
    </li>
  );
}

/** When it was made; the way to its review where there is one. */
function When({ session }: { session: Session }) {
  const when = dayAndTime(session.created_utc);
  if (!canBeReplayed(session)) return <span class="session-when">{when}</span>;
  return (
    <a
      class="session-when"
      data-testid={`review-${session.id}`}
      title={appText.reviewSession(session.id)}
      href={addressOfRoute({ kind: 'review', id: session.id, beside: null })}
    >
      {when}
    </a>
  );
}

type RowParts = { session: Session; store: Store; watcher: Watcher };

function WatchButton({ session, store, watcher }: RowParts) {
  const watched = store.sessionId.value === session.id;
  return (
    <button
      type="button"
      data-testid={`watch-${session.id}`}
      disabled={watched}
      aria-label={appText.watchSession(session.id)}
      onClick={() => watcher.watch(session.id)}
    >
      {watched ? appText.watched : appText.watch}
    </button>
  );
}

function ReplayButton({ session, store, watcher }: RowParts) {
  return (
    <button
      type="button"
      data-testid={`replay-${session.id}`}
      disabled={!canBeReplayed(session) || store.busy.value || store.hello.value?.replayOf === session.id}
      aria-label={appText.replaySession(session.id)}
      onClick={() => void watcher.openReplay(session.id)}
    >
      {appText.replay}
    </button>
  );
}
