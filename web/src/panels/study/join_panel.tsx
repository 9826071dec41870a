import { useSignal } from '@preact/signals';

import { studyText } from '../../text/study_text';
import { messageOf } from '../../wire/rest';
import type { StudyApi } from '../../wire/study_api';
import { Message } from '../common/fields';
import { type Background, ExperienceFields } from './experience_fields';
import { TextLine } from '../common/form_fields';
import { Button } from '../common/button';

/** Taking part in a study by its join code. */
export function JoinPanel({ api, onJoined }: { api: StudyApi; onJoined: (studyId: string) => void }) {
  const code = useSignal('');
  const background = useSignal<Background>({ experience: null, proceduresDone: 0 });
  const problem = useSignal<string | null>(null);
  const join = async (event: Event) => {
    event.preventDefault();
    const { experience, proceduresDone } = background.value;
    if (experience === null) return;
    problem.value = null;
    try {
      const about = { experience, procedures_done: proceduresDone };
      onJoined((await api.join(code.value.trim().toLowerCase(), about)).study);
    } catch (error) {
      problem.value = messageOf(error);
    }
  };
  return (
    <section class="content-panel" aria-labelledby="join-title">
      <h2 id="join-title">{studyText.join}</h2>
      <p class="soft">{studyText.joinHint}</p>
      <form class="content-form" onSubmit={(event) => void join(event)}>
        <TextLine
          {...{ label: studyText.joinCode, testId: 'join-code', required: true, value: code.value }}
          {...{ autocomplete: 'off', verbatim: true }}
          onInput={(typed) => (code.value = typed)}
        />
        <ExperienceFields background={background} />
        <Button submit look="main" testId="join">
          {studyText.joinButton}
        </Button>
      </form>
      {problem.value !== null && (
        <Message kind="bad" testId="join-problem">
          {problem.value}
        </Message>
      )}
    </section>
  );
}
