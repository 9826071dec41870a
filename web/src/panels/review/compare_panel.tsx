import { useEffect, useMemo } from 'preact/hooks';

import type { Pane } from './review_workspace';
import { reviewText } from '../../text/review_text';
import { canBeReplayed } from '../../state/choose_session';
import { Remote } from '../../state/remote';
import { addressOfRoute } from '../../state/route';
import { everything } from '../../state/sessions/session_browser';
import type { Session } from '../../wire/rest_types';
import { SessionListApi } from '../../wire/session_list_api';
import { Message } from '../common/fields';
import { dayAndTime, duration } from '../../text/format';

/** Sessions of the same case, to be shown beside the first. */
export function ComparePanel({ panes }: { panes: readonly Pane[] }) {
  const first = panes[0]?.session;
  const caseId = first?.details.value?.case ?? null;
  const found = useMemo(
    () =>
      new Remote(() =>
        new SessionListApi(window.location.origin).page({ ...everything, caseId: caseId ?? '' }, null, 100),
      ),
    [caseId],
  );
  useEffect(() => {
    if (caseId !== null) void found.read();
  }, [found, caseId]);
  if (first === undefined) return null;
  const second = panes[1]?.session;
  const others = (found.value.value?.sessions ?? []).filter((one) => canBeReplayed(one));
  const otherCase = second !== undefined && second.details.value !== null && second.details.value.case !== caseId;
  return (
    <section class="review-panel" aria-labelledby="compare-title" data-testid="compare">
      <h2 id="compare-title">{reviewText.compare}</h2>
      {second !== undefined && <p class="soft">{otherCase ? reviewText.otherCase : reviewText.sameCamera}</p>}
      {found.problem.value !== null && <Message kind="bad">{found.problem.value}</Message>}
      {others.length > 0 && (
        <label class="compare-choice">
          {reviewText.compareWith}{' '}
          <select
            data-testid="compare-with"
            value={second?.id ?? ''}
            onChange={(event) => {
              const beside = event.currentTarget.value;
              if (beside === '') return;
              window.location.hash = addressOfRoute({ kind: 'review', id: first.id, beside });
            }}
          >
            <option value="">{reviewText.compareChoose}</option>
            {others.map((one) => (
              <option key={one.id} value={one.id}>
                {optionLabel(one, one.id === first.id)}
              </option>
            ))}
          </select>
        </label>
      )}
    </section>
  );
}

function optionLabel(session: Session, same: boolean): string {
  const { title, trainee, participant, created_utc: when, duration_s: length } = session;
  const parts = [title || session.id, trainee || participant || '', dayAndTime(when), duration(length)];
  if (same) parts.push(`(${reviewText.compareSelf})`);
  return parts.filter((text) => text !== '').join(' · ');
}
