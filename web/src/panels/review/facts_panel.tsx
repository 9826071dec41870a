import type { Pane } from '../../pages/review_desk';
import { reviewWords } from '../../review_words';
import { words } from '../../words';
import { dayAndTime, minutes } from '../format';

/** Of whom and when the sessions are. */
export function FactsPanel({ panes }: { panes: readonly Pane[] }) {
  return (
    <section class="review-panel facts" aria-label={reviewWords.facts} data-testid="facts">
      {panes.map(({ session }, i) => {
        const details = session.details.value;
        const hello = session.store.hello.value;
        const who = details?.trainee || details?.participant || '';
        const said = [
          who === '' ? '' : words.trainedBy(who),
          (details?.attempt ?? 1) > 1 ? words.attempt(details?.attempt ?? 1) : '',
          details === null ? '' : dayAndTime(details.created_utc),
          details === null ? '' : minutes(details.duration_s),
          hello === null ? '' : words.side(hello.side),
          hello === null ? '' : hello.caseName || hello.caseId,
        ].filter((text) => text !== '');
        return (
          <div key={session.id + String(i)} class="fact">
            <h2>
              {panes.length > 1 && <span class="pane-number">{i + 1}</span>}
              {details?.title ? words.titled(details.title) : reviewWords.session(session.id)}
              {details !== null && (
                <span class={`session-word session-${details.state}`}> {words.state[details.state]}</span>
              )}
              {details?.theatre === true && (
                <span class="role-chip" title={reviewWords.theatreHint} data-testid="theatre-chip">
                  {reviewWords.theatre}
                </span>
              )}
            </h2>
            <p class="soft">{said.join(' · ')}</p>
            {details?.fault && <p class="remark remark-bad">{reviewWords.fault(details.fault)}</p>}
          </div>
        );
      })}
    </section>
  );
}
