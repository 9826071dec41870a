import { useSignal } from '@preact/signals';

import type { Remote } from '../../state/remote';
import { addressOfRoute } from '../../state/route';
import { studyWords } from '../../study_words';
import { wordsOf } from '../../wire/rest';
import type { StudyApi } from '../../wire/study_api';
import type { Participant, Person, Study } from '../../wire/study_types';
import { Remark } from '../fields';
import { Really } from '../really';
import { useIdentity } from '../site_nav';

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
      problem.value = wordsOf(error);
    }
  };
  return (
    <section class="desk-panel" aria-labelledby="participants-title">
      <div class="desk-head">
        <h2 id="participants-title">{studyWords.participants}</h2>
        {mayKnow && persons.value === null && list !== null && list.length > 0 && (
          <button
            type="button"
            class="plain-button"
            data-testid="show-persons"
            title={studyWords.personsHint}
            onClick={() => void look()}
          >
            {studyWords.showPersons}
          </button>
        )}
      </div>
      {(problem.value ?? participants.problem.value) !== null && (
        <Remark kind="bad">{problem.value ?? participants.problem.value}</Remark>
      )}
      {hidden && <p class="soft">{studyWords.hiddenHint}</p>}
      {list?.length === 0 && <p class="soft">{studyWords.noParticipants}</p>}
      {list !== null && list.length > 0 && (
        <div class="desk-scroll">
          <table class="desk-table" data-testid="participants">
            <thead>
              <tr>
                <th scope="col">{studyWords.code}</th>
                {persons.value !== null && <th scope="col">{studyWords.person}</th>}
                <th scope="col">{studyWords.experience}</th>
                <th scope="col" class="number">
                  {studyWords.proceduresShort}
                </th>
                <th scope="col">{studyWords.answered}</th>
                <th />
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
          {person?.name ?? ''}{' '}
          {(person?.user_id ?? null) === null && <span class="soft">({studyWords.noAccount})</span>}
        </td>
      )}
      <td>
        {one.experience === null ? (
          <span class="soft">{studyWords.hidden}</span>
        ) : (
          studyWords.experienceNames[one.experience]
        )}
      </td>
      <td class="number">{one.procedures_done ?? ''}</td>
      <td>
        {unknown ? (
          <span class="soft">{studyWords.hidden}</span>
        ) : (
          <span class={one.answers === null ? 'chip' : 'chip chip-good'}>
            {one.answers === null ? studyWords.answeredNo : studyWords.answeredYes}
          </span>
        )}
      </td>
      <td class="deeds">
        {study.questionnaire && (one.answers !== null || (!one.has_account && study.state === 'open')) && (
          <a
            class="plain-button"
            href={addressOfRoute({ kind: 'questionnaire', id: study.id, participant: one.code })}
            aria-label={studyWords.answersOf(one.code)}
          >
            {studyWords.enter}
          </a>
        )}
        {may.operate && (
          <Really
            label={studyWords.withdraw}
            describe={studyWords.withdrawOf(one.code)}
            question={studyWords.withdrawReally(one.code)}
            yes={studyWords.withdraw}
            no={studyWords.keep}
            testId={`withdraw-${one.code}`}
            disabled={participants.busy.value}
            onYes={() => void participants.act(() => api.withdraw(study.id, one.code))}
          />
        )}
      </td>
    </tr>
  );
}
