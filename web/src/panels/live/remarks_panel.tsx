import '../../styles/remarks_panel.css';

import { useSignal } from '@preact/signals';
import { useEffect, useMemo, useRef } from 'preact/hooks';

import { liveText } from '../../text/live_text';
import type { LiveRemarks } from '../../state/live_remarks';
import type { Store } from '../../state/store';
import { minutes } from '../../text/format';
import { useLiveKeys } from '../picture/live_keys';
import { useIdentity } from '../common/site_nav';
import { Button } from '../common/button';
import type { Annotation } from '../../wire/rest_types';

/** More are on the session's review. */
const shownMost = 5;

/** What is remarked on the session as it goes on; kept in its recording, and found again on its review. */
export function RemarksPanel({ store, remarks }: { store: Store; remarks: LiveRemarks }) {
  const may = useIdentity().may.value;
  useEffect(() => remarks.follow(), [remarks]);
  const state = store.sessionState.value;
  if (store.sessionId.value === null || state === null || state === 'created') return null;
  const all = remarks.remarks.value;
  if (!may.ream && all.length === 0) return null;
  return (
    <section class="sessions remarks" aria-labelledby="remarks-title">
      <h2 id="remarks-title">{liveText.remarks}</h2>
      {may.ream && store.live.value && <NewRemark remarks={remarks} />}
      {remarks.problem.value !== null && (
        <p class="remark-problem" role="alert">
          {remarks.problem.value}
        </p>
      )}
      <NewestRemarks all={all} />
    </section>
  );
}

function NewestRemarks({ all }: { all: readonly Annotation[] }) {
  return (
    <>
      <ol data-testid="remarks">
        {all.slice(0, shownMost).map((remark, i) => (
          <li key={all.length - i}>
            <span class="remark-time">{minutes(remark.at_s)}</span> {remark.words}
            {remark.author !== '' && <span class="soft"> {remark.author}</span>}
          </li>
        ))}
      </ol>
      {all.length > shownMost && <p class="soft">{liveText.moreRemarks(all.length - shownMost)}</p>}
    </>
  );
}

function NewRemark({ remarks }: { remarks: LiveRemarks }) {
  const text = useSignal('');
  const field = useRef<HTMLInputElement>(null);
  useLiveKeys(useMemo(() => ({ n: () => field.current?.focus() }), []));
  const at = remarks.momentS.value;
  const keep = async (event: Event) => {
    event.preventDefault();
    if (await remarks.keep(text.peek().trim())) text.value = '';
  };
  return (
    <form class="live-remark" onSubmit={(event) => void keep(event)}>
      <input
        ref={field}
        type="text"
        maxLength={400}
        data-testid="live-remark"
        aria-label={liveText.remarkLabel}
        aria-keyshortcuts="N"
        title={liveText.key(liveText.remarkLabel, 'N')}
        placeholder={liveText.remarkHint}
        value={text.value}
        onInput={(event) => {
          text.value = event.currentTarget.value;
          if (text.value.trim() === '') remarks.forget();
          else remarks.begin();
        }}
        onKeyDown={(event) => {
          if (event.key === 'Escape') event.currentTarget.blur();
        }}
      />
      <Button
        submit

        testId="keep-live-remark"
        disabled={remarks.busy.value || text.value.trim() === ''}
      >
        {at === null ? liveText.keepRemark : liveText.keepRemarkAt(minutes(at))}
      </Button>
    </form>
  );
}
