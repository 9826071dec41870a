import type { Signal } from '@preact/signals';

import type { Practice } from '../../state/practice';
import type { PracticeStore } from '../../state/practice_store';
import type { Store } from '../../state/store';
import type { Watcher } from '../../state/watcher';
import { appText } from '../../text/app_text';
import { useIdentity } from '../common/site_nav';

interface Parts {
  store: Store;
  watcher: Watcher;
  practice: Practice;
  practiceStore: PracticeStore;
  /** Something can be started now. */
  idle: boolean;
  theatreWanted: Signal<boolean>;
}

/**
 * What begins a session of one's own. After a session of a study the next attempt in it comes first, so that nobody
 * leaves a study without knowing.
 */
export function StartButtons({ store, watcher, practice, practiceStore, idle, theatreWanted }: Parts) {
  const may = useIdentity().may.value;
  const last = store.watched.value;
  const { study = null, participant = null } = last ?? {};
  // Staff who only watched somebody train do not go on in that person's place.
  const own = !may.teach || practiceStore.lastSessionId.value === last?.id;
  const inStudy = study !== null && participant !== null && may.takePart && own && last?.state !== 'created';
  const attemptAgain = async () => {
    if (last === null || study === null) return;
    const session = await watcher.train(study, may.teach ? participant : null, last.case);
    if (session?.device.name === 'browser') practice.steer(session.id);
  };
  const practise = async () => {
    const sessionId = await watcher.practise('demo', theatreWanted.value);
    if (sessionId !== null) practice.steer(sessionId);
  };
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
        class={inStudy ? 'run-button run-second' : 'run-button'}
        data-testid="practise"
        title={inStudy ? appText.practiseOutsideHint : undefined}
        disabled={!idle}
        onClick={() => void practise()}
      >
        {inStudy ? appText.practiseOutside : appText.practise}
      </button>
    </>
  );
}
