import { useMemo } from 'preact/hooks';

import { caseText } from '../../text/case_text';
import type { CaseController } from '../../state/case/case_controller';
import { type StepName, stepNames, stepStates } from '../../state/case/case_steps';
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
  const content: Record<StepName, () => preact.ComponentChildren> = {
    segment: () => <SegmentStep keeper={keeper} />,
    landmarks: () => <LandmarksStep keeper={keeper} />,
    plan: () => <PlanStep keeper={keeper} wishes={wishes} />,
    build: () => <BuildStep keeper={keeper} />,
    ream: () => <ReamStep {...{ keeper, states, startReaming }} />,
  };
  const job = store.job.value;
  if (!keeper.mayEdit)
    return (
      <aside class="steps">
        <Problem keeper={keeper} />
        <section class="step open" data-testid="step-ream">
          <h2 class="step-title">{caseText.steps.ream}</h2>
          <div class="step-body">
            {content.ream()}
            <MeasuresPanel keeper={keeper.landmarks} />
          </div>
        </section>
      </aside>
    );
  return (
    <aside class="steps">
      <Problem keeper={keeper} />
      {job !== null && job.state !== 'done' && (
        <JobProgress
          job={job}
          silent={store.jobSilent.value}
          onCancel={() => void keeper.cancelJob()}
          onDismiss={() => (store.job.value = null)}
        />
      )}
      {stepNames.map((name, i) => {
        const open = store.openStep.value === name;
        return (
          <section
            key={name}
            class={open ? 'step open' : 'step'}
            data-testid={`step-${name}`}
            data-state={states[name]}
          >
            <h2>
              <button type="button" aria-expanded={open} onClick={() => openStep(keeper, open ? null : name)}>
                <span class="step-number" aria-hidden="true">
                  {states[name] === 'done' ? '✓' : i + 1}
                </span>
                {caseText.steps[name]}
                <span class={`step-state step-${states[name]}`}>{caseText.stepStates[states[name]]}</span>
              </button>
            </h2>
            {open && <div class="step-body">{content[name]()}</div>}
          </section>
        );
      })}
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
