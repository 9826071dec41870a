import { type Signal, useSignal } from '@preact/signals';

import { caseFileText } from '../../text/case_file_text';
import { caseText } from '../../text/case_text';
import { fixed } from '../../text/format';
import type { CaseListController } from '../../state/case/new_case';
import { addressOfRoute } from '../../state/route';
import type { Reaming } from '../../state/practice_choice';
import { messageOf } from '../../wire/rest';
import type { CaseSummary, Plan } from '../../wire/rest_types';
import { ActionsColumn } from '../common/actions_column';
import { Button } from '../common/button';
import { versionText } from './angle_text';

interface Parts {
  controller: CaseListController;
  mayEdit: boolean;
  reaming: Reaming;
}

/** All cases, and what can be done with each. */
export function CaseTable({ controller, mayEdit, reaming }: Parts) {
  const starting = useSignal(false);
  const cases = controller.cases.value ?? [];
  const stale = controller.listProblem.value !== null || !controller.listFresh.value;
  const practise = async (id: string) => {
    starting.value = true;
    try {
      await reaming.start(id);
    } catch (error) {
      controller.listProblem.value = messageOf(error);
    } finally {
      starting.value = false;
    }
  };
  return (
    <div class="table-scroll">
      <table data-testid="cases" class={stale ? 'stale' : ''}>
        <thead>
          <tr>
            <th scope="col">{caseText.caseColumn}</th>
            <th scope="col">{caseText.sideColumn}</th>
            <th scope="col">{caseText.stageColumn}</th>
            <th scope="col">{caseFileText.planColumn}</th>
            <th scope="col">{caseText.voxelsColumn}</th>
            <ActionsColumn />
          </tr>
        </thead>
        <tbody>
          {cases.map((one) => (
            <CaseRow key={one.id} {...{ one, controller, mayEdit, starting, practise }} />
          ))}
        </tbody>
      </table>
    </div>
  );
}

interface RowParts {
  one: CaseSummary;
  controller: CaseListController;
  mayEdit: boolean;
  starting: Signal<boolean>;
  practise: (id: string) => Promise<void>;
}

const isReady = (one: CaseSummary): boolean => one.stage === 'built' && one.planned;

function CaseRow(parts: RowParts) {
  const { one, controller } = parts;
  const name = one.name || one.id;
  return (
    <tr data-testid={`case-${one.id}`} data-stage={one.stage}>
      <td>
        <a class="case-name" href={addressOfRoute({ kind: 'case', id: one.id })} data-testid={`open-${one.id}`}>
          {name}
        </a>
        {name !== one.id && <span class="soft case-id">{one.id}</span>}
      </td>
      <td>{caseText.sideShort[one.side]}</td>
      <td>
        <span class={isReady(one) ? 'stage-chip stage-ready' : 'stage-chip'}>
          {one.stage === 'built' && !one.planned ? caseText.stageNoPlan : caseText.stages[one.stage]}
        </span>
      </td>
      <td class="case-plan" data-testid={`plan-of-${one.id}`}>
        <PlanSummary one={one} plan={controller.plans.plans.value[one.id]} />
      </td>
      <td class="case-size">
        {one.dims === null ? <span class="soft">{caseText.notBuilt}</span> : caseText.dims(one.dims)}
        {one.spacing_mm !== null && <span class="soft case-id">{caseText.spacing(one.spacing_mm)}</span>}
      </td>
      <td class="row-actions">
        <RowActions {...parts} />
      </td>
    </tr>
  );
}

function PlanSummary({ one, plan }: { one: CaseSummary; plan: Plan | undefined }) {
  if (!one.planned) return <span class="soft">{caseFileText.noPlan}</span>;
  if (plan === undefined) return null;
  const depth = fixed(plan.depth_mm, 1);
  if (plan.version_deg === undefined) return <>{caseFileText.planSummary(depth)}</>;
  return <>{caseFileText.planSummaryWithVersion(depth, versionText(plan.version_deg))}</>;
}

function RowActions({ one, controller, mayEdit, starting, practise }: RowParts) {
  const confirming = useSignal(false);
  const name = one.name || one.id;
  if (confirming.value)
    return (
      <span class="confirm" role="alert">
        {caseText.removeConfirm(name)}
        <Button
          look="warn"
          testId={`confirm-remove-${one.id}`}
          onClick={() => {
            confirming.value = false;
            void controller.remove(one.id);
          }}
        >
          {caseText.removeYes}
        </Button>
        <Button onClick={() => (confirming.value = false)}>{caseText.keep}</Button>
      </span>
    );
  return (
    <>
      {isReady(one) && (
        <Button
          testId={`practise-${one.id}`}
          label={caseFileText.practiseOn(name)}
          disabled={starting.value}
          onClick={() => void practise(one.id)}
        >
          {caseFileText.practise}
        </Button>
      )}
      <a class="plain-button" href={addressOfRoute({ kind: 'case', id: one.id })} aria-label={caseText.openCase(name)}>
        {caseText.open}
      </a>
      {mayEdit && one.id !== 'demo' && (
        <Button testId={`remove-${one.id}`} label={caseText.removeCase(name)} onClick={() => (confirming.value = true)}>
          {caseText.remove}
        </Button>
      )}
    </>
  );
}
