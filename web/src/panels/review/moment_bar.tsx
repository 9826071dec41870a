import { liveText } from '../../text/live_text';
import { reviewText } from '../../text/review_text';
import type { ReviewSession } from '../../state/review/review_session';
import { mapNames } from '../../wire/review_api';

const maps = [null, ...mapNames];

/** What of a session is seen: before or after, bone or map. */
export function MomentBar({ session }: { session: ReviewSession }) {
  const usable = session.store.playback.value !== null;
  const map = session.map.name;
  return (
    <div class="moment-bar">
      <div class="choice" role="group" aria-label={reviewText.moment}>
        <button
          type="button"
          data-testid="before"
          aria-pressed={session.atStart.value}
          aria-keyshortcuts="B"
          title={liveText.key(reviewText.beforeHint, 'B')}
          disabled={!usable}
          onClick={() => session.showBefore()}
        >
          {reviewText.before}
        </button>
        <button
          type="button"
          data-testid="after"
          aria-pressed={session.atEnd.value}
          aria-keyshortcuts="B"
          title={liveText.key(reviewText.afterHint, 'B')}
          disabled={!usable}
          onClick={() => session.showAfter()}
        >
          {reviewText.after}
        </button>
      </div>
      <div class="choice" role="group" aria-label={reviewText.surface}>
        {maps.map((name) => (
          <button
            type="button"
            key={name}
            data-testid={`map-${name ?? 'none'}`}
            aria-pressed={map === name}
            aria-keyshortcuts="D"
            title={liveText.key(reviewText.mapHint[name ?? 'none'], 'D')}
            disabled={!usable}
            onClick={() => session.chooseMap(name)}
          >
            {reviewText.mapName[name ?? 'none']}
          </button>
        ))}
      </div>
    </div>
  );
}
