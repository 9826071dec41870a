import { liveWords } from '../../live_words';
import { reviewWords } from '../../review_words';
import type { ReviewSession } from '../../state/review/review_session';

const maps = [null, 'plan', 'implant'] as const;

/** What of a session is seen: before or after, bone or map. */
export function MomentBar({ session }: { session: ReviewSession }) {
  const usable = session.store.playback.value !== null;
  const map = session.map.name;
  return (
    <div class="moment-bar">
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
    </div>
  );
}
