import '../styles/pages.css';
import '../styles/study.css';
import '../styles/editor.css';

import { addressOfRoute, type Route } from '../state/route';
import { StudyApi } from '../wire/study_api';
import type { Study } from '../wire/rest_types';
import { noAnswer } from '../wire/rest';
import type { LivePageParts } from './live_page';
import { QuestionnairePage } from './questionnaire_page';
import { RatingPage } from './rating_page';
import { StudiesPage } from './studies_page';
import { StudyPage } from './study_page';

const api = new StudyApi(window.location.origin);

/** The pages of the studies, loaded when one of them is first opened. */
export function StudyPages({ route, live }: { route: Route; live: LivePageParts }) {
  if (route.kind === 'questionnaire')
    return <QuestionnairePage key={route.participant} api={api} studyId={route.id} code={route.participant} />;
  if (route.kind === 'rating') return <RatingPage key={route.id} api={api} studyId={route.id} />;
  if (route.kind === 'study')
    return (
      <StudyPage
        key={route.id}
        api={api}
        id={route.id}
        train={(study, participant, caseId) => train(live, study, participant, caseId)}
      />
    );
  return <StudiesPage api={api} />;
}

/** Makes a session of a study and shows it; words where that failed. */
async function train(
  { watcher, practice, store }: LivePageParts,
  study: Study,
  participant: string | null,
  caseId: string,
): Promise<string | null> {
  if (store.replayId.value !== null) watcher.leaveReplay();
  const session = await watcher.train(study.id, participant, caseId);
  if (session === null) {
    const reason = store.problem.value ?? noAnswer;
    store.problem.value = null;
    return reason;
  }
  const inBrowser = session.device.name === 'browser';
  if (study.feel) {
    // Another session under way elsewhere is not to take its place before it is answered.
    store.chosenId.value = session.id;
    window.location.hash = addressOfRoute({ kind: inBrowser ? 'live' : 'trainee' });
  } else window.location.hash = '';
  if (inBrowser) practice.steer(session.id);
  return null;
}
