import type { ComponentChildren } from 'preact';
import { useMemo } from 'preact/hooks';

import { caseText } from '../../text/case_text';
import type { CaseController } from '../../state/case/case_controller';
import { type StepName, type StepState, stepNames, stepStates } from '../../state/case/case_steps';
import { BuildStep } from './build_step';
import { Remark } from '../common/fields';
import { JobProgress } from './job_progress';
import { LandmarksStep } from './landmarks_step';
import { MeasuresPanel } from './measures_panel';
import { PlanStep, PlanWishesStore } from './plan_step';
import { ReamStep } from './ream_step';
import { SegmentStep } from './segment_step';

interface Parts {
  keeper: CaseController;
  startReaming: (caseId: string, theatre: boolean) => Promise<void>;
}

/** The steps from a CT to a reamed bone, one of them open. */
export function StepsPanel({ keeper, startReaming }: Parts) {
  const wishes = useMemo(() => new PlanWishesStore(), []);
  const { store } = keeper;
  const details = store.details.value;
  if (details === null) return null;
  const states = stepStates({
    details,
    landmarks: keeper.landmarks.landmarks.value,
    planBeforeLandmarks: store.planBeforeLandmarks.value,
  });
  const content: Record<StepName, () => ComponentChildren> = {
    segment: () => <SegmentStep keeper={keeper} />,
    landmarks: () => <LandmarksStep keeper={keeper} />,
    plan: () => <PlanStep keeper={keeper} wishes={wishes} />,
    build: () => <BuildStep keeper={keeper} />,
    ream: () => <ReamStep {...{ keeper, states, startReaming }} />,
  };
  if (!keeper.mayEdit) return <OnlyReaming keeper={keeper}>{content.ream()}</OnlyReaming>;
  return (
    <aside class="steps">
      <Problem keeper={keeper} />
      <Work keeper={keeper} />
      {stepNames.map((name, i) => (
        <Step key={name} {...{ keeper, name, number: i + 1, state: states[name], content: content[name] }} />
      ))}
      {details.warnings.length > 0 && (
        <details class="case-warnings">
          <summary>{caseText.warnings}</summary>
          {details.warnings.map((warning) => (
            <Remark kind="soft" key={warning}>
              {warning}
            </Remark>
          ))}
        </details>
      )}
    </aside>
  );
}

/** What is left of the steps for who may not change the case. */
function OnlyReaming({ keeper, children }: { keeper: CaseController; children: ComponentChildren }) {
  return (
    <aside class="steps">
      <Problem keeper={keeper} />
      <section class="step open" data-testid="step-ream">
        <h2 class="step-title">{caseText.steps.ream}</h2>
        <div class="step-body">
          {children}
          <MeasuresPanel keeper={keeper.landmarks} />
        </div>
      </section>
    </aside>
  );
}

/** The server's work on the case, until it is done. */
function Work({ keeper }: { keeper: CaseController }) {
  const { store } = keeper;
  const job = store.job.value;
  if (job === null || job.state === 'done') return null;
  return (
    <JobProgress
      job={job}
      silent={store.jobSilent.value}
      onCancel={() => void keeper.cancelJob()}
      onDismiss={() => (store.job.value = null)}
    />
  );
}

interface StepParts {
  keeper: CaseController;
  name: StepName;
  number: number;
  state: StepState;
  content: () => ComponentChildren;
}

function Step({ keeper, name, number, state, content }: StepParts) {
  const open = keeper.store.openStep.value === name;
  return (
    <section class={open ? 'step open' : 'step'} data-testid={`step-${name}`} data-state={state}>
      <h2>
        <button type="button" aria-expanded={open} onClick={() => openStep(keeper, open ? null : name)}>
          <span class="step-number" aria-hidden="true">
            {state === 'done' ? '✓' : number}
          </span>
          {caseText.steps[name]}
          <span class={`step-state step-${state}`}>{caseText.stepStates[state]}</span>
        </button>
      </h2>
      {open && <div class="step-body">{content()}</div>}
    </section>
  );
}

function openStep(keeper: CaseController, name: StepName | null): void {
  const { store } = keeper;
  store.openStep.value = name;
  const fits = store.armed.value?.kind === (name === 'segment' ? 'seed' : 'landmark');
  if (name === 'landmarks') keeper.armFirstMissing();
  else if (!fits || name !== 'segment') store.armed.value = null;
}

function Problem({ keeper }: { keeper: CaseController }) {
  const { problem } = keeper.store;
  if (problem.value === null) return null;
  return (
    <div class="problem" role="alert" data-testid="case-problem">
      <p>
        <strong>{caseText.problem}.</strong> {problem.value}
      </p>
      <button type="button" onClick={() => (problem.value = null)}>
        {caseText.dismiss}
      </button>
    </div>
  );
}
