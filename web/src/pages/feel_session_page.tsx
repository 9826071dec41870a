import '../styles/pages.css';
import '../styles/study.css';

import { useEffect, useRef } from 'preact/hooks';

import { Button } from '../panels/common/button';
import { PageHeader } from '../panels/common/page_header';
import { ProblemBanner } from '../panels/common/problem_banner';
import { beginPractice } from '../state/practice_choice';
import { addressOfRoute } from '../state/route';
import { lastCodes } from '../state/study/feel_place';
import { feelText } from '../text/feel_text';
import type { Session } from '../wire/rest_types';
import type { LivePageParts } from './live_page';

interface Parts {
  live: LivePageParts;
  session: Session;
}

/** In place of a session of a blind study of feel that is not in theatre: the way to the answer, and nothing of the bone. */
export function FeelSessionPage({ live, session }: Parts) {
  return (
    <div class="page content-page">
      <PageHeader here="live" />
      <main class="content">
        <section class="content-panel feel-panel" aria-labelledby="feel-session-title" data-testid="feel-session">
          {live.store.active.value ? <UnderWay {...{ live, session }} /> : <Ended {...{ live, session }} />}
          <ProblemBanner store={live.store} />
        </section>
      </main>
    </div>
  );
}

function Ended({ live: { store, watcher, practice, choice }, session }: Parts) {
  const answer = useRef<HTMLAnchorElement>(null);
  useEffect(() => answer.current?.focus(), []);
  const keepCode = () => {
    if (session.study !== null && session.participant !== null) lastCodes.set(session.study, session.participant);
  };
  const fault = store.fault.value;
  return (
    <>
      <h2 id="feel-session-title">{feelText.ended}</h2>
      <p class="soft">{feelText.endedHint}</p>
      {fault !== '' && <p class="message message-bad">{fault}</p>}
      <div class="feel-actions">
        <a
          class="main-button feel-button"
          data-testid="answer-now"
          ref={answer}
          href={addressOfRoute({ kind: 'study', id: session.study ?? '' })}
          onClick={keepCode}
        >
          {feelText.answerNow}
        </a>
        <Button
          testId="practise"
          disabled={store.busy.value}
          onClick={() => void beginPractice({ watcher, practice, choice })}
        >
          {feelText.outside}
        </Button>
      </div>
    </>
  );
}

/** The reamer was laid down, here or by another page. */
function UnderWay({ live: { store, watcher, practice }, session }: Parts) {
  const busy = store.busy.value;
  return (
    <>
      <h2 id="feel-session-title">{feelText.underWay}</h2>
      <p class="soft">{feelText.underWayHint}</p>
      <div class="feel-actions">
        {session.device.name === 'browser' ? (
          <Button look="main" testId="take-over" disabled={busy} onClick={() => practice.steer(session.id)}>
            {feelText.goOn}
          </Button>
        ) : (
          <a class="main-button feel-button" href={addressOfRoute({ kind: 'trainee' })}>
            {feelText.goOn}
          </a>
        )}
        <Button testId="stop" disabled={busy} onClick={() => void watcher.stop()}>
          {feelText.end}
        </Button>
      </div>
    </>
  );
}
