import { addressOfRoute } from '../../state/route';
import type { Store } from '../../state/store';
import type { Watcher } from '../../state/watcher';
import { appText } from '../../text/app_text';

/** Says that this is a recording, of what, and leads back to what is live. */
export function ReplayPanel({ store, watcher }: { store: Store; watcher: Watcher }) {
  const of = store.hello.value?.replayOf ?? '';
  const recorded = store.sessions.value.find((session) => session.id === of);
  const fault = store.fault.value;
  const warning = store.recordingWarning.value;
  return (
    <section class="replay" aria-label={appText.replayBadge} data-testid="replay-panel">
      <div class="run-buttons">
        <button
          type="button"
          class="run-button"
          data-testid="leave-replay"
          onClick={() => {
            watcher.leaveReplay();
          }}
        >
          {appText.backToLive}
        </button>
        {of !== '' && (
          <a
            class="plain-button"
            data-testid="to-review"
            href={addressOfRoute({ kind: 'review', id: of, beside: null })}
          >
            {appText.review}
          </a>
        )}
      </div>
      <p class="session-state" data-testid="session-state" data-state={store.sessionState.value} aria-live="polite">
        <strong>{appText.replayOf(of)}.</strong>{' '}
        {recorded !== undefined && appText.recordedAs(appText.state[recorded.state].toLowerCase())}
        {fault !== '' && ` ${appText.fault}: ${fault}`}
      </p>
      {warning !== null && (
        <p class="session-state" role="status" data-testid="recording-warning">
          {appText.recordingDamaged(warning)}
        </p>
      )}
    </section>
  );
}
