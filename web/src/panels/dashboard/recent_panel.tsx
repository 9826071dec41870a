import { useSignal } from '@preact/signals';

import { dashboardText } from '../../text/dashboard_text';
import { canBeReplayed } from '../../state/choose_session';
import type { Remote } from '../../state/remote';
import { addressOfRoute } from '../../state/route';
import type { Session } from '../../wire/rest_types';
import { appText } from '../../text/app_text';
import { dayAndTime, fixed } from '../../text/format';
import { Message } from '../common/fields';
import { traineeLabel } from '../common/trainee_label';
import { ReportButton } from '../common/report_button';
import { OutcomeMark } from './outcome_mark';
import { Button } from '../common/button';

const shownAtMost = 8;

interface Parts {
  ended: Remote<Session[]>;
  /** Words about what went wrong, or null. */
  replay: (id: string) => Promise<string | null>;
}

/** What has ended last, and what it was worth. */
export function RecentPanel({ ended, replay }: Parts) {
  const failed = useSignal<string | null>(null);
  const sessions = ended.value.value;
  const problem = failed.value ?? ended.problem.value;
  return (
    <section class="content-panel recent" aria-labelledby="recent-title">
      <div class="content-head">
        <h2 id="recent-title">{dashboardText.recent}</h2>
        <a class="content-count" href={addressOfRoute({ kind: 'sessions' })}>
          {dashboardText.allSessions}
        </a>
      </div>
      {problem !== null && (
        <Message kind="bad" testId="recent-problem">
          {problem}
        </Message>
      )}
      {ended.stale.value && sessions !== null && <p class="soft">{dashboardText.outOfDate}</p>}
      {sessions === null && problem === null && <p class="soft">{dashboardText.loading}</p>}
      {sessions?.length === 0 && (
        <p class="soft" data-testid="none-recent">
          {dashboardText.noneRecent}
        </p>
      )}
      {sessions !== null && sessions.length > 0 && (
        <div class="table-scroll">
          <table class={ended.stale.value ? 'data-table stale' : 'data-table'} data-testid="recent">
            <thead>
              <tr>
                <th scope="col">{dashboardText.when}</th>
                <th scope="col">{dashboardText.who}</th>
                <th scope="col">{dashboardText.case}</th>
                <th scope="col" class="number">
                  {dashboardText.points}
                </th>
                <th scope="col">{dashboardText.result}</th>
                <th scope="col">
                  <span class="visually-hidden">{dashboardText.actions}</span>
                </th>
              </tr>
            </thead>
            <tbody>
              {sessions.slice(0, shownAtMost).map((session) => (
                <Row
                  key={session.id}
                  session={session}
                  replay={async () => (failed.value = await replay(session.id))}
                  onProblem={(words) => (failed.value = words)}
                />
              ))}
            </tbody>
          </table>
        </div>
      )}
    </section>
  );
}

interface RowParts {
  session: Session;
  replay: () => Promise<unknown>;
  onProblem: (words: string) => void;
}

function Row({ session, replay, onProblem }: RowParts) {
  return (
    <tr data-testid={`recent-${session.id}`}>
      <td class="when">{dayAndTime(session.created_utc)}</td>
      <td>{traineeLabel(session)}</td>
      <td>{session.case}</td>
      <td class="number" data-testid={`points-${session.id}`}>
        {fixed(session.score?.points, 1)}
      </td>
      <td>
        {session.state === 'fault' || session.state === 'interrupted' ? (
          <span class="session-fault" title={session.fault ?? undefined}>
            {appText.state[session.state]}
          </span>
        ) : (
          <OutcomeMark outcome={session.score?.outcome ?? null} />
        )}
      </td>
      <td class="actions">
        {canBeReplayed(session) && (
          <a
            class="plain-button"
            data-testid={`recent-review-${session.id}`}
            aria-label={appText.reviewSession(session.id)}
            href={addressOfRoute({ kind: 'review', id: session.id, beside: null })}
          >
            {appText.review}
          </a>
        )}
        {canBeReplayed(session) && <ReportButton session={session.id} onProblem={onProblem} />}
        {canBeReplayed(session) && (
          <Button
            testId={`recent-replay-${session.id}`}
            label={appText.replaySession(session.id)}
            onClick={() => void replay()}
          >
            {dashboardText.replay}
          </Button>
        )}
      </td>
    </tr>
  );
}
