import type { Pane } from './review_workspace';
import { reviewText } from '../../text/review_text';
import { appText } from '../../text/app_text';
import { isDemo, traineeLabel } from '../common/trainee_label';
import { dayAndTime, duration } from '../../text/format';

/** Of whom and when the sessions are. */
export function FactsPanel({ panes }: { panes: readonly Pane[] }) {
  return (
    <section class="review-panel facts" aria-label={reviewText.facts} data-testid="facts">
      {panes.map(({ session }, i) => {
        const details = session.details.value;
        const hello = session.store.hello.value;
        const who = details?.trainee || details?.participant || '';
        const facts = [
          details !== null && isDemo(details) ? traineeLabel(details) : who === '' ? '' : appText.trainedBy(who),
          (details?.attempt ?? 1) > 1 ? appText.attempt(details?.attempt ?? 1) : '',
          details === null ? '' : dayAndTime(details.created_utc),
          details === null ? '' : duration(details.duration_s),
          hello === null ? '' : appText.side(hello.side),
          hello === null ? '' : hello.caseName || hello.caseId,
        ].filter((text) => text !== '');
        return (
          <div key={session.id + String(i)} class="fact">
            <h2>
              {panes.length > 1 && <span class="pane-number">{i + 1}</span>}
              {details?.title ? appText.titled(details.title) : reviewText.session(session.id)}
              {details !== null && (
                <span class={`session-word session-${details.state}`}> {appText.state[details.state]}</span>
              )}
              {details?.theatre === true && (
                <span class="role-chip" title={reviewText.theatreHint} data-testid="theatre-chip">
                  {reviewText.theatre}
                </span>
              )}
            </h2>
            <p class="soft">{facts.join(' · ')}</p>
            {details?.fault && <p class="message message-bad">{reviewText.fault(details.fault)}</p>}
          </div>
        );
      })}
    </section>
  );
}
