import { useEffect, useMemo } from 'preact/hooks';

import { PageHeader } from '../panels/common/page_header';
import { Message } from '../panels/common/fields';
import { useIdentity } from '../panels/common/site_nav';
import { useShownName } from '../panels/common/use_shown_name';
import { EnrolPanel } from '../panels/study/enrol_panel';
import { FeelPanel } from '../panels/study/feel_panel';
import { FeelReportPanel } from '../panels/study/feel_report';
import { ExportPanel, StudyStatePanel } from '../panels/study/study_state_panel';
import { ParticipantTable } from '../panels/study/participant_table';
import { RaterPanel } from '../panels/study/rater_panel';
import { TrainPanel } from '../panels/study/train_panel';
import { ValidityPanel } from '../panels/study/validity_panel';
import { Remote } from '../state/remote';
import { addressOfRoute } from '../state/route';
import { feelText } from '../text/feel_text';
import { studyText } from '../text/study_text';
import type { StudyApi } from '../wire/study_api';
import type { Participant, Study } from '../wire/rest_types';

interface Parts {
  api: StudyApi;
  id: string;
  train: (study: Study, participant: string | null, caseId: string) => Promise<string | null>;
}

/** One study: training in it, and for who runs it everything else. */
export function StudyPage({ api, id, train }: Parts) {
  const may = useIdentity().may.value;
  const studies = useMemo(() => new Remote(() => api.study(id)), [api, id]);
  const participants = useMemo(() => new Remote(() => api.participants(id)), [api, id]);
  useEffect(() => void studies.read(), [studies]);
  const study = studies.value.value;
  // Closing, reopening and unblinding change what may be seen of participants.
  const { state, blinded } = study ?? { state: null, blinded: null };
  useEffect(() => {
    if (may.teach && state !== null) void participants.read();
  }, [participants, may.teach, state, blinded]);
  useShownName(study?.name ?? '');
  const empty = participants.value.value?.length === 0;
  const listed = may.teach ? (participants.value.value ?? []) : [];
  const begin = async (participant: string | null, caseId: string) => {
    if (study === null) return false;
    const problem = await train(study, participant, caseId);
    if (problem !== null) studies.problem.value = problem;
    return problem === null;
  };
  const removed = () => (window.location.hash = addressOfRoute({ kind: 'studies' }));
  return (
    <div class="page content-page">
      <PageHeader here="study" />
      <main class="content">
        <section class="content-panel">
          <p>
            <a href={addressOfRoute({ kind: 'studies' })} data-testid="all-studies">
              ‹ {studyText.backToList}
            </a>
          </p>
          {studies.problem.value !== null && (
            <Message kind="bad" testId="study-problem">
              {studies.problem.value}
            </Message>
          )}
          {study === null && studies.problem.value === null && <p class="soft">{studyText.loading}</p>}
          {study !== null && <About {...{ api, study, studies, mayRun: may.teach, empty, removed }} />}
        </section>
        {study !== null && <OwnPart key={study.id} {...{ api, study, listed }} train={begin} />}
        {study !== null && may.teach && <Staff {...{ api, study, studies, participants }} />}
      </main>
    </div>
  );
}

interface OwnPartParts {
  api: StudyApi;
  study: Study;
  /** Participants among whom the user may choose. */
  listed: readonly Participant[];
  train: (participant: string | null, caseId: string) => Promise<boolean>;
}

/** What a participant does in the study, or staff in their place. */
function OwnPart({ api, study, listed, train }: OwnPartParts) {
  if (!study.feel) return <TrainPanel {...{ study, train }} codes={listed.map(({ code }) => code)} />;
  // Whoever has an account answers by it.
  const codes = listed.filter((one) => !one.has_account).map(({ code }) => code);
  return <FeelPanel {...{ api, study, codes, train }} />;
}

interface AboutParts {
  api: StudyApi;
  study: Study;
  studies: Remote<Study>;
  mayRun: boolean;
  /** Nobody takes part. */
  empty: boolean;
  removed: () => void;
}

function About({ api, study, studies, mayRun, empty, removed }: AboutParts) {
  return (
    <>
      <div class="content-head">
        <h2 data-testid="study-title">{study.name}</h2>
        <span class={study.state === 'open' ? 'chip chip-good' : 'chip'} data-testid="study-state">
          {studyText.states[study.state]}
        </span>
        {study.rates && (
          <a class="plain-button" data-testid="to-rating" href={addressOfRoute({ kind: 'rating', id: study.id })}>
            {studyText.rate}
          </a>
        )}
        {!study.blinded && <span class="chip chip-warn">{studyText.unblinded}</span>}
        {mayRun && <StudyStatePanel {...{ api, study, studies, empty }} onRemoved={removed} />}
      </div>
      {study.description !== '' && <p class="study-about">{study.description}</p>}
      <p class="soft">{factsOf(study).join(' · ')}</p>
    </>
  );
}

function factsOf(study: Study): string[] {
  const { feel } = study;
  const facts = [
    feel
      ? feelText.fact(feel.comparisons.length * feel.trials_per_comparison)
      : `${studyText.cases}: ${study.cases.join(', ')}`,
  ];
  if (study.device !== null) facts.push(`${studyText.device}: ${deviceText(study.device)}`);
  if (study.questionnaire) facts.push(`${studyText.questionnaire}: ${study.questionnaire.title}`);
  if (study.design) facts.push(`${studyText.arms}: ${study.design.arms.map((arm) => arm.name).join(', ')}`);
  return facts;
}

function deviceText(name: string): string {
  return studyText.devices.find(([device]) => device === name)?.[1].toLowerCase() ?? name;
}

interface StaffParts {
  api: StudyApi;
  study: Study;
  studies: Remote<Study>;
  participants: Remote<Participant[]>;
}

function Staff({ api, study, studies, participants }: StaffParts) {
  return (
    <>
      <ParticipantTable key={study.state} {...{ api, study, participants }} />
      {!study.feel && <RaterPanel {...{ api, study }} />}
      {study.state === 'open' && <EnrolPanel {...{ api, study, participants }} />}
      <ExportPanel {...{ api, study, studies }} />
      {study.feel ? (
        <FeelReportPanel key={`${study.id} ${study.state}`} {...{ api, study }} />
      ) : (
        <ValidityPanel key={`${study.id} ${study.state}`} {...{ api, study }} />
      )}
    </>
  );
}
