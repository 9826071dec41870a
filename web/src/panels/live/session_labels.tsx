import { addressOfRoute } from '../../state/route';
import type { Store } from '../../state/store';
import { appText } from '../../text/app_text';
import { practiceText } from '../../text/practice_text';
import { useIdentity } from '../common/site_nav';
import { isDemo } from '../common/trainee_label';
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

/** What the line of its study says is not said again. */
export function labelsOf(session: Session): string[] {
  const { title, attempt, study, participant } = session;
  const ofStudy = study !== null && participant !== null;
  const labels = [
    title ? appText.titled(title) : '',
    ofStudy ? '' : byWhom(session),
    attempt > 1 && !ofStudy ? appText.attempt(attempt) : '',
  ];
  return labels.filter((text) => text !== '');
}

/** A script reams for nobody, whoever started it. */
function byWhom(session: Session): string {
  if (isDemo(session)) return session.script === 'demo' ? practiceText.demoRun : practiceText.scriptRun;
  const who = session.trainee || session.participant;
  return who ? appText.trainedBy(who) : '';
}
