import '../styles/case.css';

import { useEffect, useMemo } from 'preact/hooks';

import { useIdentity } from '../panels/common/site_nav';
import { CaseController } from '../state/case/case_controller';
import { CaseListController } from '../state/case/new_case';
import { addressOfRoute, type Route } from '../state/route';
import type { Reaming } from '../state/practice_choice';
import { CaseApi } from '../wire/case_api';
import { CasePage } from './case_page';
import { CasesPage } from './cases_page';

const api = new CaseApi(window.location.origin);
/** Lives as long as the page, so that an upload goes on while a case is looked at. */
const cases = new CaseListController(api, window.localStorage, (caseId) => {
  if (window.location.hash === addressOfRoute({ kind: 'cases' }))
    window.location.hash = addressOfRoute({ kind: 'case', id: caseId });
});

interface Parts {
  route: Route;
  reaming: Reaming;
}

/** The pages of the cases, loaded when one of them is first opened. */
export function CasePages({ route, reaming }: Parts) {
  const { editCases } = useIdentity().may.value;
  if (route.kind === 'case') return <OneCase key={route.id} id={route.id} mayEdit={editCases} reaming={reaming} />;
  return <CasesPage controller={cases} mayEdit={editCases} reaming={reaming} />;
}

type OneCaseParts = { id: string; mayEdit: boolean; reaming: Reaming };

function OneCase({ id, mayEdit, reaming }: OneCaseParts) {
  const controller = useMemo(() => new CaseController(api, id, mayEdit), [id, mayEdit]);
  useEffect(() => {
    void controller.open();
    const leave = () => controller.landmarks.leave();
    const sendAhead = () => controller.landmarks.sendAhead();
    window.addEventListener('beforeunload', sendAhead);
    window.addEventListener('pagehide', leave);
    return () => {
      window.removeEventListener('beforeunload', sendAhead);
      window.removeEventListener('pagehide', leave);
      controller.leave();
    };
  }, [controller]);
  return <CasePage controller={controller} reaming={reaming} />;
}
