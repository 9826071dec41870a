import { useSignal } from '@preact/signals';

import type { Practice } from '../../state/practice';
import type { PracticeStore } from '../../state/practice_store';
import { isPageLost, sessionChoices } from '../../state/session_choices';
import type { Store } from '../../state/store';
import type { Watcher } from '../../state/watcher';
import { appText } from '../../text/app_text';
import { useFocusAfter } from '../common/focus_after';
import { lazyPart } from '../common/lazy_part';
import { useIdentity } from '../common/site_nav';
import { Button } from '../common/button';

const sharing = lazyPart(() => import('../access/share_panel'));

interface Parts {
  store: Store;
  watcher: Watcher;
  practice: Practice;
  practiceStore: PracticeStore;
}

/** Pausing the watched session, and starting again on intact bone. */
export function SessionControls({ store, watcher, practice, practiceStore }: Parts) {
  /** The session that is perhaps to be started again. */
  const asked = useSignal<string | null>(null);
  const confirming = asked.value !== null && asked.value === store.sessionId.value && store.active.value;
  const button = useFocusAfter<HTMLButtonElement>(confirming);
  const shared = useSignal<string | null>(null);
  const identity = useIdentity();
  const details = store.details.value;
  if (details === null || details.id !== store.sessionId.value || store.link.value.kind !== 'live') return null;
  const busy = store.busy.value;
  const { held } = details;
  const steered = practiceStore.sessionId.value === details.id;
  const pageLost = isPageLost(details);
  const { pause, startAgain } = sessionChoices({ state: store.sessionState.value, held, steered, pageLost });
  const reset = async () => {
    asked.value = null;
    const next = await watcher.reset();
    if (next !== null && steered) practice.steer(next);
  };
  if (confirming)
    return (
      <p class="session-controls confirm" role="alert">
        {appText.resetConfirm}
        <button
          type="button"
          class="warn-button"
          data-testid="confirm-reset"
          disabled={busy}
          ref={button}
          onClick={() => void reset()}
        >
          {appText.resetYes}
        </button>
        <Button onClick={() => (asked.value = null)}>{appText.no}</Button>
      </p>
    );
  const mayShare = identity.may.value.teach && identity.hasUsers.value;
  if (mayShare && shared.value === details.id)
    return sharing.show(({ SharePanel }) => <SharePanel session={details.id} onClose={() => (shared.value = null)} />);
  return (
    <div class="session-controls">
      {pause !== null && (
        <Button testId="pause-session" disabled={busy} onClick={() => void watcher.pause(pause === 'pause')}>
          {pause === 'resume' ? appText.goOn : appText.pauseSession}
        </Button>
      )}
      {startAgain && (
        <button
          type="button"
          class="plain-button"
          data-testid="reset-session"
          title={appText.resetHint}
          ref={button}
          disabled={busy}
          onClick={() => (asked.value = details.id)}
        >
          {appText.resetSession}
        </button>
      )}
      {mayShare && (
        <Button testId="share" onClick={() => (shared.value = details.id)}>
          {appText.share}
        </Button>
      )}
    </div>
  );
}
