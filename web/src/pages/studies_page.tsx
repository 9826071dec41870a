import { useEffect, useMemo } from 'preact/hooks';

import { ActionsColumn } from '../panels/common/actions_column';
import { PageHeader } from '../panels/common/page_header';
import { Message } from '../panels/common/fields';
import { dayAndTime } from '../text/format';
import { useIdentity } from '../panels/common/site_nav';
import { JoinPanel } from '../panels/study/join_panel';
import { MakeStudy } from '../panels/study/make_study';
import { Remote } from '../state/remote';
import { addressOfRoute } from '../state/route';
import { studyText } from '../text/study_text';
import type { StudyApi } from '../wire/study_api';
import type { Study } from '../wire/rest_types';

/** All studies that the user may know of, taking part in one, and making one. */
export function StudiesPage({ api }: { api: StudyApi }) {
  const identity = useIdentity();
  const may = identity.may.value;
  const studies = useMemo(() => new Remote(() => api.studies()), [api]);
  useEffect(() => void studies.read(), [studies]);
  const list = studies.value.value;
  const open = (id: string) => (window.location.hash = addressOfRoute({ kind: 'study', id }));
  return (
    <div class="page content-page">
      <PageHeader here="studies" />
      <main class="content">
        <section class="content-panel" aria-labelledby="studies-title">
          <h2 id="studies-title">{studyText.studies}</h2>
          {studies.problem.value !== null && <Message kind="bad">{studies.problem.value}</Message>}
          {list === null && studies.problem.value === null && <p class="soft">{studyText.loading}</p>}
          {list?.length === 0 && <p class="soft">{may.teach ? studyText.none : studyText.noneForYou}</p>}
          {list !== null && list.length > 0 && <Table studies={list} mayRun={may.teach} />}
        </section>
        {identity.userId.value !== null && <JoinPanel api={api} onJoined={open} />}
        {may.teach && <MakeStudy api={api} onMade={open} />}
      </main>
    </div>
  );
}

function Table({ studies, mayRun }: { studies: readonly Study[]; mayRun: boolean }) {
  return (
    <div class="table-scroll">
      <table class="data-table" data-testid="studies">
        <thead>
          <tr>
            <th scope="col">{studyText.nameColumn}</th>
            <th scope="col">{studyText.stateColumn}</th>
            {mayRun && (
              <th scope="col" class="number">
                {studyText.participantsColumn}
              </th>
            )}
            <th scope="col">{studyText.yourCodeColumn}</th>
            <ActionsColumn />
          </tr>
        </thead>
        <tbody>
          {studies.map((study) => (
            <tr key={study.id} data-testid={`study-${study.id}`}>
              <td>
                <a href={addressOfRoute({ kind: 'study', id: study.id })}>{study.name}</a>
              </td>
              <td>
                <span class={study.state === 'open' ? 'chip chip-good' : 'chip'}>
                  {studyText.states[study.state]}
                  {!study.blinded && `, ${studyText.unblinded.toLowerCase()}`}
                </span>
              </td>
              {mayRun && <td class="number">{study.participants}</td>}
              <td>{study.participant}</td>
              <td class="soft when">{dayAndTime(study.created_utc)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
