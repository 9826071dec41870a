import { useSignal } from '@preact/signals';

import { liveWords } from '../../live_words';
import { reviewWords } from '../../review_words';
import type { ReviewSession } from '../../state/review/review_session';
import { wordsOf } from '../../wire/rest';
import { words } from '../../words';
import { Remark } from '../fields';
import { minutes } from '../format';
import { useIdentity } from '../site_nav';

/** What happened, to be gone to one by one; and the present moment's remark. */
export function EventList({ session }: { session: ReviewSession }) {
  const marks = session.marks.value;
  const usable = session.store.playback.value !== null;
  const may = useIdentity().may.value;
  return (
    <div class="events">
      {([false, true] as const).map((forwards) => (
        <button
          type="button"
          key={String(forwards)}
          class="plain-button"
          data-testid={forwards ? 'next-event' : 'previous-event'}
          aria-label={forwards ? reviewWords.nextEvent : reviewWords.previousEvent}
          aria-keyshortcuts={forwards ? '.' : ','}
          title={liveWords.key(forwards ? reviewWords.nextEvent : reviewWords.previousEvent, forwards ? '.' : ',')}
          disabled={!usable}
          onClick={() => session.seekEvent(forwards)}
        >
          {forwards ? '›' : '‹'}
        </button>
      ))}
      <details class="event-list">
        <summary data-testid="events">{reviewWords.events(marks.length)}</summary>
        <div class="event-box">
          {marks.length === 0 && <p class="soft">{reviewWords.noEvents}</p>}
          <ol>
            {marks.map((mark, i) => (
              <li key={i}>
                <button type="button" data-testid="event" disabled={!usable} onClick={() => session.seek(mark.at_s)}>
                  <span class="event-time">{minutes(mark.at_s)}</span> {words.mark(mark.kind)}
                  {mark.words !== '' && mark.kind !== 'excess' && <span class="soft"> {mark.words}</span>}
                </button>
              </li>
            ))}
          </ol>
          {may.ream && <NewRemark session={session} />}
        </div>
      </details>
    </div>
  );
}

function NewRemark({ session }: { session: ReviewSession }) {
  const text = useSignal('');
  const busy = useSignal(false);
  const problem = useSignal<string | null>(null);
  const keep = async (event: Event) => {
    event.preventDefault();
    busy.value = true;
    problem.value = null;
    try {
      await session.annotate(text.value.trim());
      text.value = '';
    } catch (error) {
      problem.value = wordsOf(error);
    } finally {
      busy.value = false;
    }
  };
  return (
    <form class="new-remark" onSubmit={(event) => void keep(event)}>
      <input
        type="text"
        maxLength={400}
        data-testid="remark"
        aria-label={`${reviewWords.remark} ${minutes(session.positionS.value)}`}
        placeholder={reviewWords.remarkHint}
        value={text.value}
        onInput={(event) => (text.value = event.currentTarget.value)}
      />
      <button
        type="submit"
        class="plain-button"
        data-testid="add-remark"
        disabled={busy.value || text.value.trim() === ''}
      >
        {reviewWords.addRemark}
      </button>
      {problem.value !== null && <Remark kind="bad">{problem.value}</Remark>}
    </form>
  );
}
