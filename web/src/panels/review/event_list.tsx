import { useSignal } from '@preact/signals';

import { liveText } from '../../text/live_text';
import { reviewText } from '../../text/review_text';
import type { ReviewSession } from '../../state/review/review_session';
import { messageOf } from '../../wire/rest';
import { appText } from '../../text/app_text';
import { Message } from '../common/fields';
import { minutes } from '../../text/format';
import { Button } from '../common/button';

/** What happened, to be gone to one by one; and a new annotation of the present moment. */
export function EventList({ session, mayAnnotate }: { session: ReviewSession; mayAnnotate: boolean }) {
  const marks = session.marks.value;
  const usable = session.store.playback.value !== null;
  return (
    <div class="events">
      {([false, true] as const).map((forwards) => (
        <button
          type="button"
          key={String(forwards)}
          class="plain-button"
          data-testid={forwards ? 'next-event' : 'previous-event'}
          aria-label={forwards ? reviewText.nextEvent : reviewText.previousEvent}
          aria-keyshortcuts={forwards ? '.' : ','}
          title={liveText.key(forwards ? reviewText.nextEvent : reviewText.previousEvent, forwards ? '.' : ',')}
          disabled={!usable}
          onClick={() => session.seekEvent(forwards)}
        >
          {forwards ? '›' : '‹'}
        </button>
      ))}
      <details class="event-list">
        <summary data-testid="events">{reviewText.events(marks.length)}</summary>
        <div class="event-box">
          {marks.length === 0 && <p class="soft">{reviewText.noEvents}</p>}
          <ol>
            {marks.map((mark, i) => (
              <li key={i}>
                <button type="button" data-testid="event" disabled={!usable} onClick={() => session.seek(mark.at_s)}>
                  <span class="event-time">{minutes(mark.at_s)}</span> {appText.mark(mark.kind)}
                  {mark.words !== '' && mark.kind !== 'excess' && <span class="soft"> {mark.words}</span>}
                </button>
              </li>
            ))}
          </ol>
          {mayAnnotate && <AnnotationForm session={session} />}
        </div>
      </details>
    </div>
  );
}

function AnnotationForm({ session }: { session: ReviewSession }) {
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
      problem.value = messageOf(error);
    } finally {
      busy.value = false;
    }
  };
  return (
    <form class="annotation-form" onSubmit={(event) => void keep(event)}>
      <input
        type="text"
        maxLength={400}
        data-testid="annotation"
        aria-label={`${reviewText.annotation} ${minutes(session.positionS.value)}`}
        placeholder={reviewText.annotationHint}
        value={text.value}
        onInput={(event) => (text.value = event.currentTarget.value)}
      />
      <Button
        submit

        testId="add-annotation"
        disabled={busy.value || text.value.trim() === ''}
      >
        {reviewText.addAnnotation}
      </Button>
      {problem.value !== null && <Message kind="bad">{problem.value}</Message>}
    </form>
  );
}
