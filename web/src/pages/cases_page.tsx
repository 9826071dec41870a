import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { caseText } from '../text/case_text';
import { CaseHeader } from '../panels/case/case_header';
import { Message } from '../panels/common/fields';
import { NewCasePanel } from '../panels/case/new_case_panel';
import type { CaseListController } from '../state/case/new_case';
import { addressOfRoute } from '../state/route';
import type { CaseSummary } from '../wire/rest_types';
import { Button } from '../panels/common/button';
import { ActionsColumn } from '../panels/common/actions_column';

const readAgainMs = 5000;

/** All cases, and the making of a new one. */
export function CasesPage({ controller, mayEdit }: { controller: CaseListController; mayEdit: boolean }) {
  useEffect(() => {
    controller.listFresh.value = false;
    void controller.readCases();
    const timer = setInterval(() => void controller.readCases(), readAgainMs);
    return () => clearInterval(timer);
  }, [controller]);
  const cases = controller.cases.value;
  const problem = controller.listProblem.value;
  return (
    <div class={mayEdit ? 'page cases-page' : 'page cases-page read-only'}>
      <CaseHeader details={null} />
      <main class="case-list">
        <h2>{caseText.cases}</h2>
        {problem !== null && (
          <Message kind="bad">
            {caseText.listFailed}: {problem}
          </Message>
        )}
        {cases === null && problem === null && <p class="soft">{caseText.loadingCases}</p>}
        {cases?.length === 0 && <p class="soft">{caseText.noCases}</p>}
        {cases !== null && cases.length > 0 && (
          <table data-testid="cases" class={problem === null && controller.listFresh.value ? '' : 'stale'}>
            <thead>
              <tr>
                <th scope="col">{caseText.caseColumn}</th>
                <th scope="col">{caseText.sideColumn}</th>
                <th scope="col">{caseText.stageColumn}</th>
                <th scope="col">{caseText.voxelsColumn}</th>
                <ActionsColumn />
              </tr>
            </thead>
            <tbody>
              {cases.map((one) => (
                <CaseRow key={one.id} one={one} controller={controller} mayEdit={mayEdit} />
              ))}
            </tbody>
          </table>
        )}
      </main>
      {mayEdit && <NewCasePanel controller={controller} />}
    </div>
  );
}

function CaseRow({ one, controller, mayEdit }: { one: CaseSummary; controller: CaseListController; mayEdit: boolean }) {
  const confirming = useSignal(false);
  const name = one.name || one.id;
  const ready = one.stage === 'built' && one.planned;
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
        <span class={ready ? 'stage-chip stage-ready' : 'stage-chip'}>
          {one.stage === 'built' && !one.planned ? caseText.stageNoPlan : caseText.stages[one.stage]}
        </span>
      </td>
      <td>
        {one.dims === null ? <span class="soft">{caseText.notBuilt}</span> : caseText.dims(one.dims)}
        {one.spacing_mm !== null && <span class="soft case-id">{caseText.spacing(one.spacing_mm)}</span>}
      </td>
      <td class="row-actions">
        {confirming.value ? (
          <span class="confirm" role="alert">
            {caseText.removeConfirm(name)}
            <button
              type="button"
              class="warn-button"
              data-testid={`confirm-remove-${one.id}`}
              onClick={() => {
                confirming.value = false;
                void controller.remove(one.id);
              }}
            >
              {caseText.removeYes}
            </button>
            <Button onClick={() => (confirming.value = false)}>{caseText.keep}</Button>
          </span>
        ) : (
          <>
            <a
              class="plain-button"
              href={addressOfRoute({ kind: 'case', id: one.id })}
              aria-label={caseText.openCase(name)}
            >
              {caseText.open}
            </a>
            {mayEdit && one.id !== 'demo' && (
              <button
                type="button"
                class="plain-button"
                data-testid={`remove-${one.id}`}
                aria-label={caseText.removeCase(name)}
                onClick={() => (confirming.value = true)}
              >
                {caseText.remove}
              </button>
            )}
          </>
        )}
      </td>
    </tr>
  );
}
