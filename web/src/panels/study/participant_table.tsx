import { useSignal } from '@preact/signals';

import type { Remote } from '../../state/remote';
import { addressOfRoute } from '../../state/route';
import { studyText } from '../../text/study_text';
import { messageOf } from '../../wire/rest';
import type { StudyApi } from '../../wire/study_api';
import type { Participant, Person, Study } from '../../wire/rest_types';
import { Message } from '../common/fields';
import { ConfirmButton } from '../common/confirm_dialog';
import { useIdentity } from '../common/site_nav';
import { Button } from '../common/button';
import { ActionsColumn } from '../common/actions_column';

interface Parts {
  api: StudyApi;
  study: Study;
  participants: Remote<Participant[]>;
}

/** Who takes part, by code; who that is only when it is asked for by somebody who may know. */
export function ParticipantTable({ api, study, participants }: Parts) {
  const may = useIdentity().may.value;
  const persons = useSignal<readonly Person[] | null>(null);
  const problem = useSignal<string | null>(null);
  const list = participants.value.value;
  const mayKnow = may.operate || !study.blinded;
  const hidden = list?.some((one) => one.experience === null) ?? false;
  const look = async () => {
    try {
      persons.value = await api.persons(study.id);
      problem.value = null;
    } catch (error) {
      problem.value = messageOf(error);
    }
  };
  return (
    <section class="content-panel" aria-labelledby="participants-title">
      <div class="content-head">
        <h2 id="participants-title">{studyText.participants}</h2>
        {mayKnow && persons.value === null && list !== null && list.length > 0 && (
          <Button testId="show-persons" title={studyText.personsHint} onClick={() => void look()}>
            {studyText.showPersons}
          </Button>
        )}
      </div>
      {(problem.value ?? participants.problem.value) !== null && (
        <Message kind="bad">{problem.value ?? participants.problem.value}</Message>
      )}
      {hidden && <p class="soft">{studyText.hiddenHint}</p>}
      {list?.length === 0 && <p class="soft">{studyText.noParticipants}</p>}
      {list !== null && list.length > 0 && (
        <div class="table-scroll">
          <table class="data-table" data-testid="participants">
            <thead>
              <tr>
                <th scope="col">{studyText.code}</th>
                {persons.value !== null && <th scope="col">{studyText.person}</th>}
                <th scope="col">{studyText.experience}</th>
                <th scope="col" class="number">
                  {studyText.proceduresShort}
                </th>
                {study.design && <th scope="col">{studyText.arm}</th>}
                <th scope="col">{studyText.answered}</th>
                <ActionsColumn />
              </tr>
            </thead>
            <tbody>
              {list.map((one) => (
                <Row key={one.code} one={one} persons={persons.value} {...{ api, study, participants }} />
              ))}
            </tbody>
          </table>
        </div>
      )}
    </section>
  );
}

function Row({
  one,
  persons,
  api,
  study,
  participants,
}: Parts & { one: Participant; persons: readonly Person[] | null }) {
  const may = useIdentity().may.value;
  const person = persons?.find((known) => known.code === one.code);
  const unknown = one.experience === null;
  return (
    <tr data-testid={`participant-${one.code}`}>
      <td>
        <strong>{one.code}</strong>
      </td>
      {persons !== null && (
        <td>
          {person?.name ?? ''} {(person?.user_id ?? null) === null && <span class="soft">({studyText.noAccount})</span>}
        </td>
      )}
      <td>
        {one.experience === null ? (
          <span class="soft">{studyText.hidden}</span>
        ) : (
          studyText.experienceNames[one.experience]
        )}
      </td>
      <td class="number">{unknown ? <span class="soft">{studyText.hidden}</span> : (one.procedures_done ?? '')}</td>
      {study.design && (
        <td>
          {one.arm === null ? (
            <span class="soft">{studyText.hidden}</span>
          ) : (
            (study.design.arms.find((arm) => arm.id === one.arm)?.name ?? one.arm)
          )}
        </td>
      )}
      <td>
        {unknown ? (
          <span class="soft">{studyText.hidden}</span>
        ) : (
          <span class={one.answers === null ? 'chip' : 'chip chip-good'}>
            {one.answers === null ? studyText.answeredNo : studyText.answeredYes}
          </span>
        )}
      </td>
      <td class="actions">
        {study.questionnaire && (one.answers !== null || (!one.has_account && study.state === 'open')) && (
          <a
            class="plain-button"
            href={addressOfRoute({ kind: 'questionnaire', id: study.id, participant: one.code })}
            aria-label={studyText.answersOf(one.code)}
          >
            {studyText.enter}
          </a>
        )}
        {may.operate && (
          <ConfirmButton
            label={studyText.withdraw}
            describe={studyText.withdrawOf(one.code)}
            question={studyText.withdrawConfirm(one.code)}
            yes={studyText.withdraw}
            no={studyText.keep}
            testId={`withdraw-${one.code}`}
            disabled={participants.busy.value}
            onYes={() => void participants.act(() => api.withdraw(study.id, one.code))}
          />
        )}
      </td>
    </tr>
  );
}
