import { type Signal, useSignal } from '@preact/signals';

import type { Remote } from '../../state/remote';
import { pageText } from '../../text/page_text';
import { studyText } from '../../text/study_text';
import { AccessApi } from '../../wire/access_api';
import type { StudyApi } from '../../wire/study_api';
import type { NewParticipant, Participant, Study } from '../../wire/rest_types';
import { Message } from '../common/fields';
import { Choice, TextLine } from '../common/form_fields';
import { useRemote } from '../common/use_remote';
import { useIdentity } from '../common/site_nav';
import { type Background, ExperienceFields } from './experience_fields';
import { Button } from '../common/button';
import { CopyButton } from '../common/copy_button';

interface Parts {
  api: StudyApi;
  study: Study;
  participants: Remote<Participant[]>;
}

const guest = '-';
const nobodys: Background = { experience: null, proceduresDone: 0 };

interface Person {
  /** A user's id, `guest`, or empty. */
  who: string;
  guestName: string;
}

/** Enrolling somebody; only operators may say who it is. */
export function EnrolPanel({ api, study, participants }: Parts) {
  const identity = useIdentity();
  const background = useSignal<Background>(nobodys);
  const person = useSignal<Person>({ who: '', guestName: '' });
  const made = useSignal<string | null>(null);
  const enrol = async (event: Event) => {
    event.preventDefault();
    const wanted = newParticipant(background.value, person.value);
    if (wanted === null) return;
    const participant = await participants.act(() => api.enrol(study.id, wanted));
    if (participant === null) return;
    made.value = participant.code;
    person.value = { who: '', guestName: '' };
    background.value = nobodys;
  };
  return (
    <section class="content-panel" aria-labelledby="enrol-title">
      <h2 id="enrol-title">{studyText.enrol}</h2>
      {study.join_code !== null && identity.hasUsers.value && (
        <p class="soft">
          {studyText.enrolHint} {studyText.joinCode}: <strong data-testid="study-join-code">{study.join_code}</strong>{' '}
          <CopyButton text={study.join_code} label={pageText.copyJoinCode} testId="copy-join-code" />
        </p>
      )}
      <form class="content-form" onSubmit={(event) => void enrol(event)}>
        <PersonFields person={person} />
        <ExperienceFields background={background} />
        <Button submit look="main" testId="enrol" disabled={participants.busy.value}>
          {studyText.enrolButton}
        </Button>
      </form>
      {made.value !== null && (
        <div role="status">
          <Message kind="soft" testId="enrolled">
            {studyText.enrolled(made.value)}
          </Message>
        </div>
      )}
    </section>
  );
}

/** Null while it is not known how experienced they are. */
function newParticipant({ experience, proceduresDone }: Background, person: Person): NewParticipant | null {
  if (experience === null) return null;
  const wanted = { experience, procedures_done: proceduresDone };
  if (person.who === guest) return { ...wanted, name: person.guestName.trim() };
  return person.who === '' ? wanted : { ...wanted, user_id: person.who };
}

/** Who it is: nobody in particular, a user, or a guest by name. */
function PersonFields({ person }: { person: Signal<Person> }) {
  const identity = useIdentity();
  const operate = identity.may.value.operate;
  const users = useRemote(() => new AccessApi(window.location.origin).users(), operate && identity.hasUsers.value);
  const { who, guestName } = person.value;
  const known = users.value.value?.map((user) => [user.id, user.display_name || user.name] as const) ?? [];
  return (
    <>
      {operate && (
        <Choice
          {...{ label: studyText.enrolPerson, testId: 'enrol-user', value: who }}
          options={[['', studyText.enrolNobody], [guest, studyText.enrolGuest], ...known]}
          onChange={(chosen) => (person.value = { who: chosen, guestName })}
        />
      )}
      {who === guest && (
        <TextLine
          {...{ label: studyText.guestName, testId: 'enrol-name', required: true, maxLength: 200, value: guestName }}
          onInput={(name) => (person.value = { who, guestName: name })}
        />
      )}
    </>
  );
}
