import type { ComponentChildren } from 'preact';
import { useMemo } from 'preact/hooks';

import { caseText } from '../../text/case_text';
import { sentence } from '../../text/format';
import type { CaseController } from '../../state/case/case_controller';
import { type StepName, type StepState, stepNames, stepStates } from '../../state/case/case_steps';
import type { Reaming } from '../../state/practice_choice';
import { BuildStep } from './build_step';
import { Message } from '../common/fields';
import { JobProgress } from './job_progress';
import { LandmarksStep } from './landmarks_step';
import { MeasuresPanel } from './measures_panel';
import { PlanStep, PlanTargetsStore } from './plan_step';
import { ReamStep } from './ream_step';
import { SegmentStep } from './segment_step';

interface Parts {
  controller: CaseController;
  reaming: Reaming;
}

/** The steps from a CT to a reamed bone, one of them open. */
export function StepsPanel({ controller, reaming }: Parts) {
  const targets = useMemo(() => new PlanTargetsStore(), []);
  const { store } = controller;
  const details = store.details.value;
  if (details === null) return null;
  const states = stepStates({
    details,
    landmarks: controller.landmarks.landmarks.value,
    planBeforeLandmarks: store.planBeforeLandmarks.value,
  });
  const content: Record<StepName, () => ComponentChildren> = {
    segment: () => <SegmentStep controller={controller} />,
    landmarks: () => <LandmarksStep controller={controller} />,
    plan: () => <PlanStep controller={controller} targets={targets} />,
    build: () => <BuildStep controller={controller} />,
    ream: () => <ReamStep {...{ controller, states, reaming }} />,
  };
  if (!controller.mayEdit) return <OnlyReaming controller={controller}>{content.ream()}</OnlyReaming>;
  return (
    <aside class="steps">
      <Problem controller={controller} />
      <Work controller={controller} />
      {stepNames.map((name, i) => (
        <Step key={name} {...{ controller, name, number: i + 1, state: states[name], content: content[name] }} />
      ))}
      {details.warnings.length > 0 && (
        <details class="case-warnings">
          <summary>{caseText.warnings}</summary>
          {details.warnings.map((warning) => (
            <Message kind="soft" key={warning}>
              {sentence(warning)}
            </Message>
          ))}
        </details>
      )}
    </aside>
  );
}

/** What is left of the steps for who may not change the case. */
function OnlyReaming({ controller, children }: { controller: CaseController; children: ComponentChildren }) {
  return (
    <aside class="steps">
      <Problem controller={controller} />
      <section class="step open" data-testid="step-ream">
        <h2 class="step-title">{caseText.steps.ream}</h2>
        <div class="step-body">
          {children}
          <MeasuresPanel controller={controller.landmarks} />
        </div>
      </section>
    </aside>
  );
}

/** The server's work on the case, until it is done. */
function Work({ controller }: { controller: CaseController }) {
  const { store } = controller;
  const job = store.job.value;
  if (job === null || job.state === 'done') return null;
  return (
    <JobProgress
      job={job}
      silent={store.jobSilent.value}
      onCancel={() => void controller.cancelJob()}
      onDismiss={() => (store.job.value = null)}
    />
  );
}

interface StepParts {
  controller: CaseController;
  name: StepName;
  number: number;
  state: StepState;
  content: () => ComponentChildren;
}

function Step({ controller, name, number, state, content }: StepParts) {
  const open = controller.store.openStep.value === name;
  return (
    <section class={open ? 'step open' : 'step'} data-testid={`step-${name}`} data-state={state}>
      <h2>
        <button type="button" aria-expanded={open} onClick={() => openStep(controller, open ? null : name)}>
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

function openStep(controller: CaseController, name: StepName | null): void {
  const { store } = controller;
  store.openStep.value = name;
  const fits = store.armed.value?.kind === (name === 'segment' ? 'seed' : 'landmark');
  if (name === 'landmarks') controller.armFirstMissing();
  else if (!fits || name !== 'segment') store.armed.value = null;
}

function Problem({ controller }: { controller: CaseController }) {
  const { problem } = controller.store;
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
