import { useSignal } from '@preact/signals';
import { useEffect, useMemo } from 'preact/hooks';

import { Remote } from '../../state/remote';
import { studyText } from '../../text/study_text';
import { AccessApi } from '../../wire/access_api';
import type { Rater, Study } from '../../wire/rest_types';
import type { StudyApi } from '../../wire/study_api';
import { Button } from '../common/button';
import { ConfirmButton } from '../common/confirm_dialog';
import { Message } from '../common/fields';
import { Choice } from '../common/form_fields';
import { useIdentity } from '../common/site_nav';
import { useRemote } from '../common/use_remote';
import { ActionsColumn } from '../common/actions_column';

interface Parts {
  api: StudyApi;
  study: Study;
}

/** Who rates the study's sessions, and how far they are. */
export function RaterPanel({ api, study }: Parts) {
  const identity = useIdentity();
  const raters = useMemo(() => new Remote(() => api.raters(study.id)), [api, study.id]);
  useEffect(() => void raters.read(), [raters]);
  const list = raters.value.value;
  if (!study.rating_form || !identity.hasUsers.value) return null;
  return (
    <section class="content-panel" aria-labelledby="raters-title">
      <h2 id="raters-title">{studyText.raters}</h2>
      <p class="soft">{studyText.ratersHint}</p>
      {raters.problem.value !== null && <Message kind="bad">{raters.problem.value}</Message>}
      {list?.length === 0 && <p class="soft">{studyText.noRaters}</p>}
      {list !== null && list.length > 0 && <Table {...{ api, study, raters, list }} />}
      {identity.may.value.operate && study.state === 'open' && <AddRater {...{ api, study, raters }} />}
    </section>
  );
}

type RaterParts = Parts & { raters: Remote<Rater[]> };

function Table({ api, study, raters, list }: RaterParts & { list: readonly Rater[] }) {
  return (
    <div class="table-scroll">
      <table class="data-table" data-testid="raters">
        <thead>
          <tr>
            <th scope="col">{studyText.rater}</th>
            <th scope="col">{studyText.person}</th>
            <th scope="col">{studyText.ratedColumn}</th>
            <ActionsColumn />
          </tr>
        </thead>
        <tbody>
          {list.map((rater) => (
            <Row key={rater.label} {...{ api, study, raters, rater }} />
          ))}
        </tbody>
      </table>
    </div>
  );
}

function Row({ api, study, raters, rater }: RaterParts & { rater: Rater }) {
  const may = useIdentity().may.value;
  return (
    <tr data-testid={`rater-${rater.label}`}>
      <td>
        <strong>{rater.label}</strong>
      </td>
      <td>{rater.name}</td>
      <td>{studyText.ratedOf(rater.rated, rater.to_rate)}</td>
      <td class="actions">
        {may.operate && (
          <ConfirmButton
            label={studyText.removeRater}
            describe={studyText.removeRaterOf(rater.label)}
            question={studyText.removeRaterConfirm(rater.label)}
            {...{ yes: studyText.removeRater, no: studyText.keep }}
            testId={`remove-rater-${rater.label}`}
            disabled={raters.busy.value}
            onYes={() => void raters.act(() => api.removeRater(study.id, rater.label))}
          />
        )}
      </td>
    </tr>
  );
}

function AddRater({ api, study, raters }: RaterParts) {
  const users = useRemote(() => new AccessApi(window.location.origin).users());
  const chosen = useSignal('');
  const known = (users.value.value ?? [])
    .filter((user) => user.role === 'instructor')
    .map((user) => [user.id, user.display_name || user.name] as const);
  const add = async (event: Event) => {
    event.preventDefault();
    if (chosen.value === '') return;
    if ((await raters.act(() => api.addRater(study.id, chosen.value))) !== null) chosen.value = '';
  };
  return (
    <form class="content-form" onSubmit={(event) => void add(event)}>
      <Choice
        {...{ label: studyText.chooseRater, testId: 'rater-user', required: true, value: chosen.value }}
        options={[['', ''], ...known]}
        onChange={(id) => (chosen.value = id)}
      />
      <Button submit testId="add-rater" disabled={raters.busy.value || chosen.value === ''}>
        {studyText.addRater}
      </Button>
    </form>
  );
}
