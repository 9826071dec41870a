import type { ReviewDesk } from '../../pages/review_desk';
import { liveWords } from '../../live_words';
import { reviewWords } from '../../review_words';
import { addressOfRoute } from '../../state/route';
import type { ReviewSession } from '../../state/review/review_session';
import { words } from '../../words';

const maps = [null, 'plan', 'implant'] as const;

interface Parts {
  session: ReviewSession;
  place: number;
  several: boolean;
  desk: ReviewDesk;
}

/** What of a session is seen: before or after, bone or map. */
export function MomentBar({ session, place, several, desk }: Parts) {
  const usable = session.store.playback.value !== null;
  const map = session.map.name;
  const details = session.details.value;
  const other = desk.panes.value[1 - place]?.session.id;
  return (
    <div class="moment-bar">
      {several && (
        <p class="pane-title">
          <span class="pane-number">{place + 1}</span>
          {details?.title ? words.titled(details.title) : details?.trainee || details?.participant || session.id}
        </p>
      )}
      <div class="choice" role="group" aria-label={reviewWords.moment}>
        <button
          type="button"
          data-testid="before"
          aria-pressed={session.atStart.value}
          aria-keyshortcuts="B"
          title={liveWords.key(reviewWords.beforeHint, 'B')}
          disabled={!usable}
          onClick={() => session.showBefore()}
        >
          {reviewWords.before}
        </button>
        <button
          type="button"
          data-testid="after"
          aria-pressed={session.atEnd.value}
          aria-keyshortcuts="B"
          title={liveWords.key(reviewWords.afterHint, 'B')}
          disabled={!usable}
          onClick={() => session.showAfter()}
        >
          {reviewWords.after}
        </button>
      </div>
      <div class="choice" role="group" aria-label={reviewWords.surface}>
        {maps.map((name) => (
          <button
            type="button"
            key={name}
            data-testid={`map-${name ?? 'none'}`}
            aria-pressed={map === name}
            aria-keyshortcuts="D"
            title={liveWords.key(reviewWords.mapHint[name ?? 'none'], 'D')}
            disabled={!usable}
            onClick={() => session.chooseMap(name)}
          >
            {reviewWords.mapName[name ?? 'none']}
          </button>
        ))}
      </div>
      {other !== undefined && (
        <a
          class="close-pane"
          data-testid={`close-${place}`}
          aria-label={reviewWords.closePane(session.id)}
          href={addressOfRoute({ kind: 'review', id: other, beside: null })}
        >
          {reviewWords.close}
        </a>
      )}
    </div>
  );
}
