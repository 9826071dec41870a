import { useSignal } from '@preact/signals';
import { useEffect, useMemo } from 'preact/hooks';

import { Remote } from '../../state/remote';
import { studyText } from '../../text/study_text';
import { AccessApi } from '../../wire/access_api';
import type { StudyApi } from '../../wire/study_api';
import type { NewParticipant, Participant, Study } from '../../wire/rest_types';
import { Remark } from '../common/fields';
import { useIdentity } from '../common/site_nav';
import { type Background, ExperienceFields } from './experience_fields';

interface Parts {
  api: StudyApi;
  study: Study;
  participants: Remote<Participant[]>;
}

const guest = '-';

/** Enrolling somebody; only operators may say who it is. */
export function EnrolPanel({ api, study, participants }: Parts) {
  const identity = useIdentity();
  const operate = identity.may.value.operate;
  const users = useMemo(() => new Remote(() => new AccessApi(window.location.origin).users()), []);
  useEffect(() => {
    if (operate && identity.hasUsers.value) void users.read();
  }, [users, operate]);
  const background = useSignal<Background>({ experience: null, proceduresDone: 0 });
  const who = useSignal('');
  const name = useSignal('');
  const made = useSignal<string | null>(null);
  const enrol = async (event: Event) => {
    event.preventDefault();
    const { experience, proceduresDone } = background.value;
    if (experience === null) return;
    const wanted: NewParticipant = { experience, procedures_done: proceduresDone };
    if (who.value === guest) wanted.name = name.value.trim();
    else if (who.value !== '') wanted.user_id = who.value;
    const participant = await participants.act(() => api.enrol(study.id, wanted));
    if (participant === null) return;
    made.value = participant.code;
    who.value = '';
    name.value = '';
    background.value = { experience: null, proceduresDone: 0 };
  };
  return (
    <section class="desk-panel" aria-labelledby="enrol-title">
      <h2 id="enrol-title">{studyText.enrol}</h2>
      {study.join_code !== null && identity.hasUsers.value && (
        <p class="soft">
          {studyText.enrolHint} {studyText.joinCode}: <strong data-testid="study-join-code">{study.join_code}</strong>
        </p>
      )}
      <form class="desk-form" onSubmit={(event) => void enrol(event)}>
        {operate && (
          <label>
            {studyText.enrolPerson}
            <select
              data-testid="enrol-who"
              value={who.value}
              onChange={(event) => (who.value = event.currentTarget.value)}
            >
              <option value="">{studyText.enrolNobody}</option>
              <option value={guest}>{studyText.enrolGuest}</option>
              {users.value.value?.map((user) => (
                <option key={user.id} value={user.id}>
                  {user.display_name || user.name}
                </option>
              ))}
            </select>
          </label>
        )}
        {who.value === guest && (
          <label>
            {studyText.guestName}
            <input
              type="text"
              required
              maxLength={200}
              data-testid="enrol-name"
              value={name.value}
              onInput={(event) => (name.value = event.currentTarget.value)}
            />
          </label>
        )}
        <ExperienceFields background={background} />
        <button type="submit" class="main-button" data-testid="enrol" disabled={participants.busy.value}>
          {studyText.enrolButton}
        </button>
      </form>
      {made.value !== null && (
        <div role="status">
          <Remark kind="soft" testId="enrolled">
            {studyText.enrolled(made.value)}
          </Remark>
        </div>
      )}
    </section>
  );
}
