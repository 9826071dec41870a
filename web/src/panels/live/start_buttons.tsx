import { beginNext, goesOnInStudy } from '../../state/next_session';
import type { Practice } from '../../state/practice';
import { beginPractice, type PracticeChoice } from '../../state/practice_choice';
import type { PracticeStore } from '../../state/practice_store';
import { hasReamed } from '../../state/newcomer';
import type { Store } from '../../state/store';
import type { Tutorial } from '../../state/tutorial_guide';
import type { Watcher } from '../../state/watcher';
import { appText } from '../../text/app_text';
import { tutorialText } from '../../text/tutorial_text';
import { Button } from '../common/button';
import { useIdentity } from '../common/site_nav';

interface Parts {
  store: Store;
  watcher: Watcher;
  practice: Practice;
  practiceStore: PracticeStore;
  tutorial: Tutorial;
  /** Something can be started now. */
  idle: boolean;
  choice: PracticeChoice;
}

/**
 * What begins a session of one's own. Who has none yet is offered the tutorial first. After a session of a study the
 * next attempt in it comes first, so that nobody leaves a study without knowing.
 */
export function StartButtons({ store, watcher, practice, practiceStore, tutorial, idle, choice }: Parts) {
  const identity = useIdentity();
  const may = identity.may.value;
  const last = store.watched.value;
  const inStudy = goesOnInStudy(last, { may, steeredLast: practiceStore.lastSessionId.value });
  const attemptAgain = async () => {
    if (last !== null) await beginNext('attempt', last, { watcher, practice, may, choice });
  };
  const newcomer =
    !inStudy &&
    tutorial.remembered.value === null &&
    practiceStore.lastSessionId.value === null &&
    store.sessionsKnown.value &&
    !hasReamed(store.sessions.value, { userId: identity.userId.value, teach: may.teach });
  return (
    <>
      {inStudy && (
        <button
          type="button"
          class="run-button"
          data-testid="next-attempt"
          disabled={!idle}
          onClick={() => void attemptAgain()}
        >
          {appText.nextAttempt}
        </button>
      )}
      <button
        type="button"
        class={newcomer ? 'run-button run-first' : 'run-button run-second'}
        data-testid="tutorial-start"
        title={tutorialText.hint}
        disabled={!idle}
        onClick={() => void tutorial.start()}
      >
        {tutorialText.tutorial}
      </button>
      <button
        type="button"
        class={inStudy || newcomer ? 'run-button run-second' : 'run-button'}
        data-testid="practise"
        title={inStudy ? appText.practiseOutsideHint : undefined}
        disabled={!idle}
        onClick={() => void beginPractice({ watcher, practice, choice })}
      >
        {inStudy ? appText.practiseOutside : appText.practise}
      </button>
      {newcomer && (
        <p class="tutorial-offer" data-testid="tutorial-offer">
          {tutorialText.offer} <Button onClick={() => tutorial.skip()}>{tutorialText.notNow}</Button>
        </p>
      )}
    </>
  );
}
