import { useSignal } from '@preact/signals';
import { useEffect, useMemo } from 'preact/hooks';

import { addressOfRoute } from '../../state/route';
import { lastCodes, TrialPlace } from '../../state/study/feel_place';
import { feelText } from '../../text/feel_text';
import { studyText } from '../../text/study_text';
import type { FeelTrial, PlateName, Study } from '../../wire/rest_types';
import type { StudyApi } from '../../wire/study_api';
import { Button } from '../common/button';
import { Message } from '../common/fields';
import { useFocusAfter } from '../common/focus_after';
import { Choice } from '../common/form_fields';
import { useIdentity } from '../common/site_nav';

interface Parts {
  api: StudyApi;
  study: Study;
  /** Of participants without an account, for whom staff runs the trials. */
  codes: readonly string[];
  /** Makes the session of the next trial for a participant (null: the user) and shows it; false when that failed. */
  train: (participant: string | null, caseId: string) => Promise<boolean>;
}

/** The trials of a blind study of feel, one after the other, for whoever takes part. */
export function FeelPanel({ api, study, codes, train }: Parts) {
  const may = useIdentity().may.value;
  const own = study.participant;
  const choice = useSignal(lastCodes.get(study.id) ?? '');
  const code = codes.includes(choice.value) ? choice.value : own;
  const choose = (chosen: string) => {
    choice.value = chosen;
    lastCodes.set(study.id, chosen);
  };
  if (study.state === 'closed' || (own === null && codes.length === 0)) return null;
  return (
    <section class="content-panel feel-panel" aria-labelledby="feel-title" data-testid="feel-panel">
      <h2 id="feel-title">{own === null ? feelText.run : feelText.yourPart}</h2>
      {own !== null && (
        <p class="soft" data-testid="own-code">
          {studyText.yourCode(own)}
        </p>
      )}
      {may.teach && codes.length > 0 && (
        <div class="content-form">
          <Choice
            {...{ label: feelText.participant, testId: 'train-as', value: code ?? '' }}
            options={[own ?? '', ...codes].map((one) => [one, one])}
            onChange={choose}
          />
        </div>
      )}
      {code !== null && (
        <Trials key={code} {...{ api, study, code }} train={() => train(code === own ? null : code, '')} />
      )}
    </section>
  );
}

interface TrialsParts {
  api: StudyApi;
  study: Study;
  code: string;
  train: () => Promise<boolean>;
}

function Trials({ api, study, code, train }: TrialsParts) {
  const here = useMemo(() => new TrialPlace(api, study.id, code), [api, study.id, code]);
  useEffect(() => void here.place.read(), [here]);
  const problem = here.place.problem.value;
  const place = here.place.value.value;
  return (
    <>
      {problem !== null && (
        <Message kind="bad" testId="feel-problem">
          {problem}
        </Message>
      )}
      {place === null && problem === null && <p class="soft">{feelText.loading}</p>}
      {place?.trial === null && <AllDone study={study} code={code} />}
      {place?.trial && <Trial trial={place.trial} {...{ here, train }} />}
    </>
  );
}

function AllDone({ study, code }: { study: Study; code: string }) {
  return (
    <div class="feel-actions">
      <p role="status" data-testid="feel-done">
        {feelText.done}
      </p>
      {study.questionnaire && (
        <a
          class="plain-button"
          data-testid="own-answers"
          href={addressOfRoute({ kind: 'questionnaire', id: study.id, participant: code })}
        >
          {feelText.questionnaire}
        </a>
      )}
    </div>
  );
}

interface TrialParts {
  trial: FeelTrial;
  here: TrialPlace;
  train: () => Promise<boolean>;
}

/** One thing to do at a time: to feel the plates, then to answer. */
function Trial({ trial, here, train }: TrialParts) {
  const starting = useSignal(false);
  const heading = useFocusAfter<HTMLHeadingElement>(trial.number);
  const feel = async () => {
    starting.value = true;
    if (!(await train())) starting.value = false;
  };
  const felt = trial.session !== null;
  const busy = starting.value || here.place.busy.value;
  return (
    <>
      <h3 class="feel-trial" data-testid="feel-trial" ref={heading} tabIndex={-1}>
        {feelText.trial(trial.number, trial.of)}
      </h3>
      <p class="feel-question" data-testid="feel-question">
        {trial.question}
      </p>
      <p class="soft">{felt ? feelText.toAnswer : feelText.toFeel}</p>
      <div class="feel-actions">
        {felt && <Answers busy={busy} answer={(chosen) => void here.answer(chosen)} />}
        <Button look={felt ? 'plain' : 'main'} testId="feel-plates" disabled={busy} onClick={() => void feel()}>
          {starting.value ? feelText.starting : felt ? feelText.feelAgain : feelText.feel}
        </Button>
      </div>
    </>
  );
}

/** One above the other, as the plates are. */
function Answers({ busy, answer }: { busy: boolean; answer: (chosen: PlateName) => void }) {
  return (
    <div class="feel-answers" role="group" aria-label={feelText.answers}>
      {feelText.plates.map(([plate, words]) => (
        <button
          key={plate}
          type="button"
          class="main-button feel-answer"
          data-testid={`answer-${plate}`}
          disabled={busy}
          // The second click of a double click was for what was here before.
          onClick={(event) => event.detail <= 1 && answer(plate)}
        >
          {words}
        </button>
      ))}
    </div>
  );
}
