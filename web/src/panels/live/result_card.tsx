import '../../styles/result_card.css';

import { useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';

import { beginNext, nextSession } from '../../state/next_session';
import type { Practice } from '../../state/practice';
import type { PracticeChoice } from '../../state/practice_choice';
import type { PracticeStore } from '../../state/practice_store';
import type { ResultWatch } from '../../state/result_watch';
import { addressOfRoute } from '../../state/route';
import type { Store } from '../../state/store';
import type { Watcher } from '../../state/watcher';
import { appText } from '../../text/app_text';
import { fixed, percent, sentence } from '../../text/format';
import { resultText } from '../../text/result_text';
import type { Score, Session } from '../../wire/rest_types';
import type { ReviewApi } from '../../wire/review_api';
import { Button } from '../common/button';
import { useExport } from '../common/use_export';
import { useIdentity } from '../common/site_nav';
import { OutcomeMark } from '../dashboard/outcome_mark';
import { Figure } from './figures';

/** All advice is on the review. */
const adviceMost = 3;

interface Parts {
  store: Store;
  watcher: Watcher;
  practice: Practice;
  practiceStore: PracticeStore;
  choice: PracticeChoice;
  result: ResultWatch;
  review: ReviewApi;
  scene: { canvas: HTMLCanvasElement };
  /** A tutorial says what comes next, and has the focus. */
  quiet?: boolean;
}

/** Over the picture once the watched session has ended: what it was worth, and what to do next. */
export function ResultCard(parts: Parts) {
  const id = parts.result.shown.value;
  const session = parts.store.watched.value;
  return id === null || session === null ? null : <Card key={id} {...parts} session={session} />;
}

function Card({ session, quiet, ...parts }: Parts & { session: Session }) {
  const { result, scene, store } = parts;
  const card = useRef<HTMLElement>(null);
  useEffect(() => {
    if (quiet !== true && !writes(document.activeElement)) card.current?.focus();
  }, []);
  const close = () => {
    result.close();
    scene.canvas.focus({ preventScroll: true });
  };
  return (
    <section
      class="result-card"
      role="region"
      aria-labelledby="result-title"
      tabIndex={-1}
      ref={card}
      data-testid="result-card"
      onKeyDown={(event) => {
        if (event.key !== 'Escape') return;
        event.preventDefault();
        close();
      }}
    >
      <div class="result-head">
        <h2 id="result-title">{resultText.title}</h2>
        <Button testId="close-result" label={resultText.close} title={resultText.close} onClick={close}>
          <span aria-hidden="true">✕</span>
        </Button>
      </div>
      <div class="result-words" aria-live="polite">
        <Words {...{ result, store }} />
      </div>
      <Buttons {...parts} session={session} quiet={quiet} />
    </section>
  );
}

/** Whoever writes is not taken away from it. */
const writes = (element: Element | null) =>
  element instanceof HTMLTextAreaElement || (element instanceof HTMLInputElement && element.type === 'text');

function Words({ result, store }: Pick<Parts, 'result' | 'store'>) {
  const answer = result.result.value;
  if (answer === null) return <p class="soft">{resultText.scoring}</p>;
  if (answer.kind === 'failed') return <p data-testid="result-failed">{resultText.noScore(sentence(answer.reason))}</p>;
  return (
    <>
      <Mark score={answer.score} />
      <Figures store={store} />
    </>
  );
}

function Mark({ score }: { score: Score }) {
  const { points, outcome, rubric, advice } = score;
  const passMark = rubric.rubric.pass_points;
  const removed = score.metrics.find(({ metric }) => metric === 'removed_volume_mm3')?.value;
  const why = otherThanPoints(score);
  return (
    <>
      <p class="result-mark" data-testid="result-mark" data-outcome={outcome ?? 'none'}>
        <OutcomeMark outcome={outcome} />
        <span>
          <strong>{points === null ? resultText.noPoints : fixed(points, 1)}</strong>
          {points !== null && ` ${resultText.points}`}
        </span>
      </p>
      {passMark !== undefined && <p class="soft">{resultText.passMark(String(passMark))}</p>}
      {removed === 0 ? (
        <p data-testid="result-untouched">{resultText.noBone}</p>
      ) : (
        <>
          {why !== null && <p>{sentence(why)}</p>}
          <Advice advice={advice} />
        </>
      )}
    </>
  );
}

/** Why the session has not passed, where its points do not say so. */
function otherThanPoints({ points, outcome, rubric, reasons }: Score): string | null {
  const enough = points === null || points >= (rubric.rubric.pass_points ?? 0);
  return outcome === 'pass' || outcome === null || !enough ? null : (reasons[0] ?? null);
}

function Advice({ advice }: Pick<Score, 'advice'>) {
  if (advice.length === 0) return null;
  return (
    <>
      <h3>{resultText.nextTime}</h3>
      <ol data-testid="result-advice">
        {advice.slice(0, adviceMost).map(({ metric, words }) => (
          <li key={metric}>{words}</li>
        ))}
      </ol>
    </>
  );
}

function Figures({ store }: Pick<Parts, 'store'>) {
  const metrics = store.metrics.value;
  // Without contact all of it is nothing.
  if (metrics === null || metrics.removed_volume_mm3 === 0) return null;
  return (
    <dl class="figures" aria-label={resultText.figures} data-testid="results">
      <Figure name={resultText.meanThrust} unit="N">
        {fixed(metrics.axial_thrust_mean_n, 1)}
      </Figure>
      <Figure name={resultText.peakThrust} unit="N">
        {fixed(metrics.axial_thrust_peak_n, 1)}
      </Figure>
      <Figure name={resultText.cortical} unit="mm³">
        {fixed(metrics.removed_volume_cortical_mm3, 0)}
      </Figure>
      <Figure name={resultText.cancellous} unit="mm³">
        {fixed(metrics.removed_volume_cancellous_mm3, 0)}
      </Figure>
    </dl>
  );
}

function Buttons({
  session,
  quiet,
  store,
  watcher,
  practice,
  practiceStore,
  choice,
  review,
}: Omit<Parts, 'result' | 'scene'> & { session: Session }) {
  const may = useIdentity().may.value;
  const next = quiet === true ? null : nextSession(session, { may, steeredLast: practiceStore.lastSessionId.value });
  const recorded = session.tick > 0 || (store.telemetry.value?.tick ?? 0) > 0;
  return (
    <div class="result-buttons">
      {next !== null && (
        <Button
          look="main"
          testId="try-again"
          title={
            next === 'again' ? resultText.startAgainHint : next === 'practise' ? resultText.practiseHint : undefined
          }
          disabled={store.busy.value}
          onClick={() => void beginNext(next, session, { watcher, practice, may, choice })}
        >
          {{ attempt: appText.nextAttempt, again: resultText.startAgain, practise: appText.practise }[next]}
        </Button>
      )}
      {recorded && (
        <a
          class="plain-button"
          data-testid="result-review"
          href={addressOfRoute({ kind: 'review', id: session.id, beside: null })}
        >
          {appText.review}
        </a>
      )}
      {recorded && may.ream && <ReportButton session={session} review={review} />}
    </div>
  );
}

function ReportButton({ session, review }: { session: Session; review: ReviewApi }) {
  const problem = useSignal<string | null>(null);
  const { share, make } = useExport(review, session.id, 'pdf', (reason) => {
    problem.value = reason === null ? null : resultText.reportFailed(sentence(reason));
  });
  return (
    <>
      <Button testId="result-report" disabled={share !== null} onClick={() => void make()}>
        {share === null ? resultText.report : resultText.making(percent(share))}
      </Button>
      {problem.value !== null && <p role="alert">{problem.value}</p>}
    </>
  );
}
