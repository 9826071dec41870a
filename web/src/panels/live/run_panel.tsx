import type { Practice } from '../../state/practice';
import type { PracticeChoice } from '../../state/practice_choice';
import type { PracticeStore } from '../../state/practice_store';
import type { ResultWatch } from '../../state/result_watch';
import type { Store } from '../../state/store';
import type { Tutorial } from '../../state/tutorial_guide';
import type { Watcher } from '../../state/watcher';
import { appText } from '../../text/app_text';
import { resultText } from '../../text/result_text';
import { isPageLost, sessionChoices } from '../../state/session_choices';
import { Button } from '../common/button';
import { PracticeChooser } from './practice_chooser';
import { SessionControls } from './session_controls';
import { SessionLabels } from './session_labels';
import { StartButtons } from './start_buttons';
import { useIdentity } from '../common/site_nav';

interface Parts {
  store: Store;
  watcher: Watcher;
  practice: Practice;
  practiceStore: PracticeStore;
  tutorial: Tutorial;
  choice: PracticeChoice;
  result: ResultWatch;
}

/** The things to do, and what the session is doing. */
export function RunPanel({ store, watcher, practice, practiceStore, tutorial, choice, result }: Parts) {
  const may = useIdentity().may.value;
  const reachable = store.link.value.kind === 'live' || store.link.value.kind === 'nothing';
  const active = reachable && store.active.value;
  const idle = reachable && !active && !store.busy.value;
  const running = practiceStore.sessionId.value === null ? appText.running : appText.practising;
  const left = active && isLeft(store, practiceStore);
  return (
    <section class="run" aria-label={appText.runDemo}>
      {may.ream && (
        <div class="run-buttons">
          {!active && <StartButtons {...{ store, watcher, practice, practiceStore, tutorial, idle, choice }} />}
          {left ? (
            <p class="session-left" data-testid="session-left" role="status">
              {appText.sessionLeft}
            </p>
          ) : (
            <button
              type="button"
              class={active ? 'run-button' : 'run-button run-second'}
              data-testid="run-demo"
              disabled={!idle}
              onClick={() => void watcher.runDemo()}
            >
              {store.busy.value ? appText.starting : active ? running : appText.runDemo}
            </button>
          )}
          {active && <TakeOver left={left} store={store} practice={practice} practiceStore={practiceStore} />}
          {active && (
            <button
              type="button"
              class="stop-button"
              data-testid="stop"
              disabled={store.busy.value}
              onClick={() => void watcher.stop()}
            >
              {left ? appText.endLeft : appText.stop}
            </button>
          )}
        </div>
      )}
      {may.ream && !active && <PracticeChooser choice={choice} />}
      {may.ream && <SessionControls {...{ store, watcher, practice, practiceStore }} />}
      <ShowResult result={result} />
      <StateLine store={store} practiceStore={practiceStore} reachable={reachable} />
      <SessionLabels store={store} />
    </section>
  );
}

/** The way back to a card that was closed, or to that of a session that ended before the page was opened. */
function ShowResult({ result }: { result: ResultWatch }) {
  if (result.ended.value === null || result.shown.value !== null) return null;
  return (
    <div class="session-controls">
      <Button testId="show-result" onClick={() => result.show()}>
        {resultText.show}
      </Button>
    </div>
  );
}

function isLeft({ watched, sessionState }: Store, practiceStore: PracticeStore): boolean {
  const session = watched.value;
  if (session === null) return false;
  const steered = practiceStore.sessionId.value === session.id;
  return sessionChoices({ state: sessionState.value, held: session.held, steered, pageLost: isPageLost(session) }).left;
}

/** For pages that watch while another one steers, or did until it was closed. */
function TakeOver({
  store,
  practice,
  practiceStore,
  left,
}: Pick<Parts, 'store' | 'practice' | 'practiceStore'> & { left: boolean }) {
  const id = store.sessionId.value;
  const details = store.details.value;
  if (id === null || details?.id !== id || details.device.name !== 'browser' || practiceStore.sessionId.value === id)
    return null;
  return (
    <button
      type="button"
      class="stop-button take-over"
      data-testid="take-over"
      title={left ? appText.continueLeftHint : appText.takeOverHint}
      onClick={() => practice.steer(id)}
    >
      {left ? appText.continueLeft : appText.takeOver}
    </button>
  );
}

function StateLine({
  store,
  practiceStore,
  reachable,
}: Pick<Parts, 'store' | 'practiceStore'> & { reachable: boolean }) {
  const state = store.sessionState.value;
  if (state === null) return null;
  const fault = store.fault.value;
  return (
    <p class="session-state" data-testid="session-state" data-state={state} aria-live="polite">
      {reachable ? (
        <>
          <strong>{appText.state[state]}.</strong> {hint(store, practiceStore, state)}
          {fault !== '' && ` ${state === 'fault' ? `${appText.fault}: ` : ''}${fault}`}
        </>
      ) : (
        appText.stateUnknown(appText.state[state].toLowerCase())
      )}
    </p>
  );
}

function hint(store: Store, practiceStore: PracticeStore, state: keyof typeof appText.stateHint): string {
  if (state !== 'running') return appText.stateHint[state];
  if (practiceStore.sessionId.value !== null) return appText.practiceHint;
  const details = store.details.value;
  const device = details?.id === store.sessionId.value ? details?.device.name : undefined;
  if (device === 'browser') return appText.takeOverHint;
  return device === undefined || device === 'script' ? appText.stateHint.running : appText.deviceHint;
}
