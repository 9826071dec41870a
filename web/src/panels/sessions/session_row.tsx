import { useSignal } from '@preact/signals';

import { sessionWords } from '../../session_words';
import { canBeReplayed, isActive } from '../../state/choose_session';
import type { SessionBrowser } from '../../state/sessions/session_browser';
import type { Session } from '../../wire/api';
import { words } from '../../words';
import { dayAndTime, minutes } from '../format';
import { useFocusAfter } from '../focus_after';
import { Really } from '../really';
import { useIdentity } from '../site_nav';

interface Parts {
  session: Session;
  browser: SessionBrowser;
  watch: (session: Session) => void;
  replay: (session: Session) => void;
}

/** One session, and what can be done about it. */
export function SessionRow({ session, browser, watch, replay }: Parts) {
  const may = useIdentity().may.value;
  const { attempt = 1 } = session;
  const live = isActive(session) || session.state === 'created';
  const busy = browser.page.busy.value;
  return (
    <tr data-testid={`row-${session.id}`} data-state={session.state}>
      <td>{dayAndTime(session.created_utc)}</td>
      <td>
        <Title session={session} browser={browser} />
      </td>
      <td>
        {session.case} {attempt > 1 && <span class="soft">{sessionWords.attempt(attempt)}</span>}
      </td>
      <td>{session.trainee || session.participant}</td>
      <td>
        <span class={`session-word session-${session.state}`}>{words.state[session.state]}</span>
      </td>
      <td class="number">{minutes(session.duration_s)}</td>
      <td class="deeds">
        {live && session.streamable !== false && (
          <button
            type="button"
            class="plain-button"
            data-testid={`watch-${session.id}`}
            aria-label={words.watchSession(session.id)}
            onClick={() => watch(session)}
          >
            {sessionWords.watch}
          </button>
        )}
        {canBeReplayed(session) && (
          <button
            type="button"
            class="plain-button"
            data-testid={`replay-${session.id}`}
            aria-label={words.replaySession(session.id)}
            onClick={() => replay(session)}
          >
            {sessionWords.replay}
          </button>
        )}
        {may.deleteSessions && !live && (
          <Really
            label={sessionWords.remove}
            describe={sessionWords.removeOf(session.id)}
            question={sessionWords.removeReally}
            yes={sessionWords.remove}
            no={sessionWords.keep}
            testId={`remove-${session.id}`}
            disabled={busy}
            onYes={() => void browser.remove(session)}
          />
        )}
      </td>
    </tr>
  );
}

function Title({ session, browser }: Pick<Parts, 'session' | 'browser'>) {
  const draft = useSignal<string | null>(null);
  const place = useFocusAfter<HTMLButtonElement & HTMLInputElement>(draft.value === null);
  const title = session.title ?? '';
  if (draft.value === null)
    return (
      <button
        type="button"
        class="title-button"
        ref={place}
        data-testid={`title-${session.id}`}
        aria-label={sessionWords.renameOf(session.id)}
        onClick={() => (draft.value = title)}
      >
        {title === '' ? <span class="soft">{sessionWords.untitled}</span> : title}
      </button>
    );
  const save = async (event: Event) => {
    event.preventDefault();
    if (await browser.change(session.id, { title: (draft.value ?? '').trim() })) draft.value = null;
  };
  return (
    <form class="title-form" onSubmit={(event) => void save(event)}>
      <input
        type="text"
        maxLength={200}
        ref={place}
        aria-label={sessionWords.renameOf(session.id)}
        data-testid={`new-title-${session.id}`}
        value={draft.value}
        onInput={(event) => (draft.value = event.currentTarget.value)}
        onKeyDown={(event) => {
          if (event.key === 'Escape') draft.value = null;
        }}
      />
      <button type="submit" class="plain-button" data-testid={`save-title-${session.id}`}>
        {sessionWords.save}
      </button>
      <button type="button" class="plain-button" onClick={() => (draft.value = null)}>
        {sessionWords.cancel}
      </button>
    </form>
  );
}
