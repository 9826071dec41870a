import { useSignal } from '@preact/signals';

import { addressOfRoute } from '../../state/route';
import { studyText } from '../../text/study_text';
import type { Study } from '../../wire/rest_types';
import { Choice } from '../common/form_fields';
import { useIdentity } from '../common/site_nav';
import { Button } from '../common/button';

interface Parts {
  study: Study;
  /** Codes among which the user may choose; empty: only their own. */
  codes: readonly string[];
  /** Makes a session for a participant (null: the user) and shows it; false when that failed. */
  train: (participant: string | null, caseId: string) => Promise<boolean>;
}

/** Beginning a session of the study, and the way to the questionnaire. */
export function TrainPanel({ study, codes, train }: Parts) {
  const may = useIdentity().may.value;
  const own = study.participant;
  const choice = useSignal(own ?? '');
  const caseId = useSignal(study.cases[0] ?? '');
  const busy = useSignal(false);
  const participant = codes.includes(choice.value) ? choice.value : own;
  const start = async (event: Event) => {
    event.preventDefault();
    if (participant === null) return;
    busy.value = true;
    // With a design the server knows which case is next.
    const wanted = study.design ? '' : caseId.value;
    if (!(await train(participant === own ? null : participant, wanted))) busy.value = false;
  };
  if (study.state === 'closed' || (own === null && codes.length === 0)) return null;
  return (
    <section class="content-panel" aria-labelledby="train-title">
      <h2 id="train-title">{own === null ? studyText.train : studyText.yourPart}</h2>
      {own !== null && (
        <p class="soft" data-testid="own-code">
          {studyText.yourCode(own)}
        </p>
      )}
      {own !== null && study.design && <NextSession study={study} />}
      <form class="content-form" onSubmit={(event) => void start(event)}>
        {may.teach && codes.length > 0 && (
          <Choice
            {...{ label: studyText.trainsAs, testId: 'train-as', required: true, value: participant ?? '' }}
            options={[['', ''], ...codes.map((code) => [code, code] as const)]}
            onChange={(code) => (choice.value = code)}
          />
        )}
        {study.cases.length > 1 && !study.design && (
          <Choice
            {...{ label: studyText.onCase, testId: 'train-on', value: caseId.value }}
            options={study.cases.map((id) => [id, id])}
            onChange={(id) => (caseId.value = id)}
          />
        )}
        <Button
          submit
          look="main"
          title={studyText.trainHint}
          testId="train"
          disabled={busy.value || participant === null}
        >
          {busy.value ? studyText.starting : studyText.start}
        </Button>
        {own !== null && study.questionnaire && (
          <a
            class="plain-button"
            data-testid="own-answers"
            href={addressOfRoute({ kind: 'questionnaire', id: study.id, participant: own })}
          >
            {studyText.answerNow}
          </a>
        )}
      </form>
    </section>
  );
}

/** What the design asks of the user next. */
function NextSession({ study }: { study: Study }) {
  const next = study.next_session;
  if (!next)
    return (
      <p class="soft" data-testid="next-session">
        {studyText.allDone}
      </p>
    );
  return (
    <p class="soft" data-testid="next-session">
      {studyText.next(studyText.phases[next.phase], next.number, next.of)}{' '}
      {next.not_before !== null && studyText.nextFrom(next.not_before)}
    </p>
  );
}
