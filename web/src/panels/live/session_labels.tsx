import { addressOfRoute } from '../../state/route';
import type { Store } from '../../state/store';
import { appText } from '../../text/app_text';
import { useIdentity } from '../common/site_nav';
import type { Session } from '../../wire/rest_types';

/** Whose session it is, what it is called, and what is left to do after one of a study. */
export function SessionLabels({ store }: { store: Store }) {
  const identity = useIdentity();
  const details = store.details.value;
  if (details === null || details.id !== store.sessionId.value) return null;
  const { participant, study } = details;
  const labels = labelsOf(details);
  const ended = !store.active.value && details.state !== 'created';
  const answers = identity.may.value.takePart && ended && study && participant;
  if (labels.length === 0 && !answers) return null;
  return (
    <>
      {labels.length > 0 && (
        <p class="session-labels soft" data-testid="session-labels">
          {labels.join(' · ')}
        </p>
      )}
      {answers && (
        <p class="message" data-testid="questionnaire-notice">
          {appText.questionnaireOpen}{' '}
          <a href={addressOfRoute({ kind: 'questionnaire', id: study, participant })}>{appText.toQuestionnaire}</a>
        </p>
      )}
    </>
  );
}

function labelsOf({ title, trainee, participant, attempt, study }: Session): string[] {
  const labels = [
    study ? appText.inStudy : '',
    title ? appText.titled(title) : '',
    trainee || participant ? appText.trainedBy(trainee || participant || '') : '',
    attempt > 1 ? appText.attempt(attempt) : '',
  ];
  return labels.filter((text) => text !== '');
}
