import '../../styles/annotations_panel.css';

import { useSignal } from '@preact/signals';
import { useEffect, useMemo, useRef } from 'preact/hooks';

import { liveText } from '../../text/live_text';
import type { LiveAnnotations } from '../../state/live_annotations';
import type { Store } from '../../state/store';
import { minutes } from '../../text/format';
import { useLiveKeys } from '../picture/live_keys';
import { useIdentity } from '../common/site_nav';
import { Button } from '../common/button';
import type { Annotation } from '../../wire/rest_types';

/** More are on the session's review. */
const shownMost = 5;

/** What is remarked on the session as it goes on; kept in its recording, and found again on its review. */
export function AnnotationsPanel({ store, annotations }: { store: Store; annotations: LiveAnnotations }) {
  const may = useIdentity().may.value;
  useEffect(() => annotations.follow(), [annotations]);
  const state = store.sessionState.value;
  if (store.sessionId.value === null || state === null || state === 'created') return null;
  const all = annotations.annotations.value;
  if (!may.ream && all.length === 0) return null;
  return (
    <section class="sessions annotations" aria-labelledby="annotations-title">
      <h2 id="annotations-title">{liveText.annotations}</h2>
      {may.ream && store.live.value && <AnnotationForm annotations={annotations} />}
      {annotations.problem.value !== null && (
        <p class="annotation-problem" role="alert">
          {annotations.problem.value}
        </p>
      )}
      <AnnotationList all={all} />
    </section>
  );
}

function AnnotationList({ all }: { all: readonly Annotation[] }) {
  return (
    <>
      <ol data-testid="annotations">
        {all.slice(0, shownMost).map((annotation, i) => (
          <li key={all.length - i}>
            <span class="annotation-time">{minutes(annotation.at_s)}</span> {annotation.words}
            {annotation.author !== '' && <span class="soft"> {annotation.author}</span>}
          </li>
        ))}
      </ol>
      {all.length > shownMost && <p class="soft">{liveText.moreAnnotations(all.length - shownMost)}</p>}
    </>
  );
}

function AnnotationForm({ annotations }: { annotations: LiveAnnotations }) {
  const text = useSignal('');
  const field = useRef<HTMLInputElement>(null);
  useLiveKeys(useMemo(() => ({ n: () => field.current?.focus() }), []));
  const at = annotations.momentS.value;
  const keep = async (event: Event) => {
    event.preventDefault();
    if (await annotations.keep(text.peek().trim())) text.value = '';
  };
  return (
    <form class="live-annotation" onSubmit={(event) => void keep(event)}>
      <input
        ref={field}
        type="text"
        maxLength={400}
        data-testid="live-annotation"
        aria-label={liveText.annotationLabel}
        aria-keyshortcuts="N"
        title={liveText.key(liveText.annotationLabel, 'N')}
        placeholder={liveText.annotationHint}
        value={text.value}
        onInput={(event) => {
          text.value = event.currentTarget.value;
          if (text.value.trim() === '') annotations.forget();
          else annotations.begin();
        }}
        onKeyDown={(event) => {
          if (event.key !== 'Escape') return;
          // Nothing else ends by the same press.
          event.preventDefault();
          event.currentTarget.blur();
        }}
      />
      <Button
        submit

        testId="keep-live-annotation"
        disabled={annotations.busy.value || text.value.trim() === ''}
      >
        {at === null ? liveText.keepAnnotation : liveText.keepAnnotationAt(minutes(at))}
      </Button>
    </form>
  );
}
