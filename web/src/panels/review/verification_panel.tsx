import { useEffect, useMemo } from 'preact/hooks';

import type { ReviewSession } from '../../state/review/review_session';
import {
  SessionVerification,
  type VerificationSources,
  type VerificationState,
} from '../../state/review/session_verification';
import { percent, sentence } from '../../text/format';
import { reviewText } from '../../text/review_text';
import type { Verification } from '../../twin/verification_worker';
import { Button } from '../common/button';

interface Parts {
  session: ReviewSession;
  sources: VerificationSources;
  /** Without being asked to. */
  atOnce?: boolean;
}

/** Has this browser compute a session's bone again from what was recorded. */
export function VerificationPanel({ session, sources, atOnce = false }: Parts) {
  const { id } = session;
  const verification = useMemo(() => new SessionVerification(sources), [sources]);
  useEffect(() => {
    if (atOnce) void verification.run();
  }, [verification, atOnce]);
  useEffect(() => () => verification.dispose(), [verification]);
  if (session.error.value !== null) return null;
  const state = verification.state.value;
  const words = wordsOf(state);
  // A screen reader says what changes in a place that is there all the time.
  return (
    <section class="review-panel" aria-label={`${reviewText.verification}, ${id}`} data-testid="verification">
      <h2>{reviewText.verification}</h2>
      <p class="soft">{reviewText.verificationHint}</p>
      <Button testId="verify" onClick={() => void verification.run()}>
        {reviewText.verify}
      </Button>
      <div role="status" data-testid="verification-result">
        {words !== '' && <p class={`message message-${isBad(state) ? 'bad' : 'soft'}`}>{words}</p>}
      </div>
    </section>
  );
}

function resultOf({ outcome, ticks, recordedTicks }: Verification): string {
  if (outcome !== 'agrees') return reviewText.notAgreeing[outcome](ticks / 1000);
  return recordedTicks === null || recordedTicks === ticks
    ? reviewText.verified(ticks / 1000)
    : reviewText.partlyVerified(ticks / 1000, recordedTicks / 1000);
}

const isBad = (state: VerificationState) =>
  state.kind === 'impossible' ||
  state.kind === 'refused' ||
  (state.kind === 'done' && state.verification.outcome !== 'agrees');

function wordsOf(state: VerificationState): string {
  switch (state.kind) {
    case 'idle':
      return '';
    case 'preparing':
      return sentence(reviewText.making(percent(state.share)));
    case 'computing':
      return reviewText.verifying(state.ticks / 1000);
    case 'done':
      return resultOf(state.verification);
    case 'impossible':
      return reviewText.notVerified[state.obstacle];
    case 'refused':
      return reviewText.verificationRefused(sentence(state.reason));
  }
}
