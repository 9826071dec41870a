import { useSignal } from '@preact/signals';

import { sessionText } from '../../text/session_text';
import { canBeReplayed, isActive } from '../../state/choose_session';
import { addressOfRoute } from '../../state/route';
import type { SessionBrowser } from '../../state/sessions/session_browser';
import type { Session } from '../../wire/rest_types';
import { appText } from '../../text/app_text';
import { dayAndTime, duration, fixed } from '../../text/format';
import { useFocusAfter } from '../common/focus_after';
import { ConfirmButton } from '../common/confirm_dialog';
import { useIdentity } from '../common/site_nav';
import { Button } from '../common/button';
import { isDemo, traineeLabel } from '../common/trainee_label';
import { OutcomeMark } from '../dashboard/outcome_mark';
import { ReportButton } from '../common/report_button';

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
      <td class="when">{dayAndTime(session.created_utc)}</td>
      <td>
        <Title session={session} browser={browser} />
      </td>
      <td>
        {session.case} {attempt > 1 && <span class="soft">{sessionText.attempt(attempt)}</span>}
      </td>
      <td>{isDemo(session) ? traineeLabel(session) : session.trainee || session.participant}</td>
      <td>
        <span class={`session-word session-${session.state}`}>{appText.state[session.state]}</span>
      </td>
      <td class="number when">{duration(session.duration_s)}</td>
      <td class="number" data-testid={`points-${session.id}`}>
        {live ? '' : fixed(session.score?.points, 1)}
      </td>
      <td>{!live && <OutcomeMark outcome={session.score?.outcome ?? null} />}</td>
      <td class="actions">
        {live && session.streamable && (
          <Button
            testId={`watch-${session.id}`}
            label={appText.watchSession(session.id)}
            onClick={() => watch(session)}
          >
            {sessionText.watch}
          </Button>
        )}
        {canBeReplayed(session) && (
          <a
            class="plain-button"
            data-testid={`review-${session.id}`}
            aria-label={appText.reviewSession(session.id)}
            href={addressOfRoute({ kind: 'review', id: session.id, beside: null })}
          >
            {appText.review}
          </a>
        )}
        {canBeReplayed(session) && (
          <ReportButton session={session.id} onProblem={(words) => (browser.page.problem.value = words)} />
        )}
        {canBeReplayed(session) && (
          <Button
            testId={`replay-${session.id}`}
            label={appText.replaySession(session.id)}
            onClick={() => replay(session)}
          >
            {sessionText.replay}
          </Button>
        )}
        {may.deleteSessions && !live && (
          <ConfirmButton
            label={sessionText.remove}
            describe={sessionText.removeOf(session.id)}
            question={sessionText.removeConfirm}
            yes={sessionText.remove}
            no={sessionText.keep}
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
        aria-label={sessionText.renameOf(session.id)}
        onClick={() => (draft.value = title)}
      >
        {title === '' ? <span class="soft">{sessionText.untitled}</span> : title}
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
        aria-label={sessionText.renameOf(session.id)}
        data-testid={`new-title-${session.id}`}
        value={draft.value}
        onInput={(event) => (draft.value = event.currentTarget.value)}
        onKeyDown={(event) => {
          if (event.key === 'Escape') draft.value = null;
        }}
      />
      <Button submit testId={`save-title-${session.id}`}>
        {sessionText.save}
      </Button>
      <Button onClick={() => (draft.value = null)}>{sessionText.cancel}</Button>
    </form>
  );
}
