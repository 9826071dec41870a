import { useEffect } from 'preact/hooks';

import { caseText } from '../text/case_text';
import { CaseHeader } from '../panels/case/case_header';
import { CaseTable } from '../panels/case/case_table';
import { Message } from '../panels/common/fields';
import { NewCasePanel } from '../panels/case/new_case_panel';
import type { CaseListController } from '../state/case/new_case';
import type { Reaming } from '../state/practice_choice';

const readAgainMs = 5000;

interface Parts {
  controller: CaseListController;
  mayEdit: boolean;
  reaming: Reaming;
}

/** All cases, and the making of a new one. */
export function CasesPage({ controller, mayEdit, reaming }: Parts) {
  useEffect(() => {
    controller.listFresh.value = false;
    controller.plans.forget();
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
        {cases !== null && cases.length > 0 && <CaseTable {...{ controller, mayEdit, reaming }} />}
      </main>
      {mayEdit && <NewCasePanel controller={controller} />}
    </div>
  );
}
