import { Fragment } from 'preact';
import { useState } from 'preact/hooks';

import { caseText } from '../../text/case_text';
import type { CaseController } from '../../state/case/case_controller';
import type { PlanDraft } from '../../state/case/case_store';
import { add, length } from '../../ct/volume_frame';
import type { PlanAssessment, Plan, PlanOutcome, Reamer, Triple } from '../../wire/rest_types';
import { fixed, sentence } from '../../text/format';
import { inclinationText, versionText } from './angle_text';
import { outcomeRows, outcomeWarning } from './outcome_text';
import { plannedReamerText } from './reamer_text';
import { NumberBox, NumberField, Message } from '../common/fields';
import { Button } from '../common/button';

/** The proposed or kept plan by numbers, what it would do, and keeping it. */
export function PlanDraftPanel({ controller, draft }: { controller: CaseController; draft: PlanDraft }) {
  const { plan, assessment, outcome, isAssessed, kept } = draft;
  const problem = controller.store.predictionProblem.value;
  const stale = !isAssessed;
  const change = (part: Partial<Plan>) => controller.draftPlan({ ...plan, ...part });
  const overrideReason = controller.store.overrideRequired.value;
  return (
    <section class="plan-draft" data-testid="plan-draft" data-kept={kept}>
      <p class={kept ? 'good' : 'warn-text'} data-testid="plan-state">
        {kept ? caseText.planKept : caseText.planDraft}
      </p>
      <PointField
        label={caseText.entry}
        value={plan.entry_mm}
        step={0.5}
        decimals={1}
        testId="entry"
        onChange={(entry_mm) => change({ entry_mm })}
      />
      <PointField
        label={caseText.axis}
        value={plan.axis_direction}
        step={0.01}
        decimals={3}
        testId="axis"
        onChange={(direction) => {
          const size = length(direction);
          if (size > 1e-6) change({ axis_direction: add([0, 0, 0], direction, 1 / size) });
        }}
      />
      <NumberField
        {...{ label: caseText.depth, unit: caseText.mm, value: plan.depth_mm, low: 0, high: 15, step: 0.5 }}
        testId="plan-depth"
        onChange={(depth_mm) => change({ depth_mm })}
      />
      <PlanFacts plan={plan} reamers={controller.store.reamers.value} />
      {problem !== null && <Message kind="warn">{caseText.planNotPredicted(problem)}</Message>}
      <p role="status">{problem === null && (stale || outcome === null) ? caseText.planPredicting : ''}</p>
      {assessment !== null && <AssessmentFigures assessment={assessment} stale={stale} />}
      {outcome !== null && <OutcomeFigures outcome={outcome} stale={stale} />}
      {overrideReason !== null || (isAssessed && assessment?.needs_override === true) ? (
        <Override
          controller={controller}
          message={overrideReason}
          kept={kept && !controller.store.planBeforeLandmarks.value}
        />
      ) : (
        <div class="buttons">
          <Button
            look="main"
            testId="keep-plan"
            disabled={(kept && !controller.store.planBeforeLandmarks.value) || controller.store.busy.value}
            onClick={() => void controller.keepPlan(null)}
          >
            {caseText.keepPlan}
          </Button>
        </div>
      )}
    </section>
  );
}

/** What of the plan is not edited here. */
function PlanFacts({ plan, reamers }: { plan: Plan; reamers: readonly Reamer[] }) {
  const { pilot_diameter_mm: diameter, pilot_depth_mm: depth } = plan;
  const hasPilot = typeof diameter === 'number' && typeof depth === 'number';
  return (
    <dl class="figures-list">
      <dt>{caseText.reamer}</dt>
      <dd>{plannedReamerText(plan.reamer, reamers)}</dd>
      <dt>{caseText.guide}</dt>
      <dd>{caseText.guides[plan.guide ?? 'none']}</dd>
      <dt>{caseText.pilotHole}</dt>
      <dd>{hasPilot ? caseText.pilotSize(fixed(diameter, 1), fixed(depth, 1)) : caseText.noPilot}</dd>
    </dl>
  );
}

function AssessmentFigures({ assessment, stale }: { assessment: PlanAssessment; stale: boolean }) {
  const { correction_deg, version_after_deg, inclination_after_deg, vault_depth_mm, warnings } = assessment;
  return (
    <>
      <dl class={stale ? 'figures-list stale' : 'figures-list'}>
        <dt>{caseText.correction}</dt>
        <dd data-testid="correction">
          {correction_deg === null ? caseText.unknown : caseText.fixed(fixed(correction_deg, 1), '°')}
        </dd>
        <dt>{caseText.after}</dt>
        <dd>
          {versionText(version_after_deg)}, {inclinationText(inclination_after_deg)}
        </dd>
        {typeof vault_depth_mm === 'number' && (
          <>
            <dt>{caseText.vaultDepth}</dt>
            <dd>{caseText.fixed(fixed(vault_depth_mm, 1), caseText.mm)}</dd>
          </>
        )}
      </dl>
      {warnings.map((warning) => (
        <Message kind="warn" key={warning} testId="plan-warning">
          {sentence(warning)}
        </Message>
      ))}
    </>
  );
}

/** What the plan reaches where it is carried out exactly. */
function OutcomeFigures({ outcome, stale }: { outcome: PlanOutcome; stale: boolean }) {
  const rows = outcomeRows(outcome);
  const warning = outcomeWarning(outcome);
  return (
    <section data-testid="plan-outcome">
      <h3>{caseText.planResult}</h3>
      <p class="soft">{caseText.planResultHint}</p>
      <dl class={stale ? 'figures-list stale' : 'figures-list'}>
        {rows.map(([name, value]) => (
          <Fragment key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </Fragment>
        ))}
      </dl>
      {warning !== null && !stale && (
        <Message kind="warn" testId="outcome-warning">
          {warning}
        </Message>
      )}
    </section>
  );
}

/** Keeping what is refused without a reason. */
function Override({
  controller,
  message,
  kept,
}: {
  controller: CaseController;
  message: string | null;
  kept: boolean;
}) {
  const [reason, setReason] = useState('');
  if (kept) return null;
  return (
    <div class="override" role="alert" data-testid="override">
      <p>
        <strong>{caseText.overrideTitle}.</strong> {message}
      </p>
      <label>
        {caseText.overrideReason}
        <textarea
          rows={2}
          data-testid="override-reason"
          value={reason}
          onInput={(event) => setReason(event.currentTarget.value)}
        />
      </label>
      <Button
        look="warn"
        testId="override-keep"
        disabled={reason.trim() === '' || controller.store.busy.value}
        onClick={() => void controller.keepPlan(reason.trim())}
      >
        {caseText.overrideKeep}
      </Button>
    </div>
  );
}

interface PointParts {
  label: string;
  value: Triple;
  step: number;
  decimals: number;
  testId: string;
  onChange: (value: Triple) => void;
}

/** Three numbers of LPS. */
function PointField({ label, value, step, decimals, testId, onChange }: PointParts) {
  return (
    <div class="field">
      <span class="field-name">{label}</span>
      <div class="three-numbers">
        {caseText.lps.map((name, i) => (
          <label key={name}>
            <span class="soft">{name}</span>
            <NumberBox
              {...{ label: `${label}, ${name}`, unit: '', value: value[i] ?? 0, low: -5000, high: 5000 }}
              {...{ step, decimals, testId: `${testId}-${i}` }}
              onChange={(number) => onChange(value.map((old, j) => (j === i ? number : old)) as Triple)}
            />
          </label>
        ))}
      </div>
    </div>
  );
}
