import type { Store } from '../state/store';
import type { Watcher } from '../state/watcher';
import { words } from '../words';

/** The one thing to do, and what the session is doing. */
export function RunPanel({ store, watcher }: { store: Store; watcher: Watcher }) {
  const state = store.sessionState.value;
  const reachable = store.link.value.kind === 'live';
  const active = reachable && store.active.value;
  const fault = state === 'fault' ? store.telemetry.value?.fault : '';
  const label = store.busy.value ? words.starting : active ? words.running : words.runDemo;
  return (
    <section class="run" aria-label={words.runDemo}>
      <div class="run-buttons">
        <button
          type="button"
          class="run-button"
          data-testid="run-demo"
          disabled={!reachable || active || store.busy.value}
          onClick={() => void watcher.runDemo()}
        >
          {label}
        </button>
        {active && (
          <button
            type="button"
            class="stop-button"
            data-testid="stop"
            disabled={store.busy.value}
            onClick={() => void watcher.stop()}
          >
            {words.stop}
          </button>
        )}
      </div>
      {state !== null && (
        <p class="session-state" data-testid="session-state" data-state={state} aria-live="polite">
          {reachable ? (
            <>
              <strong>{words.state[state]}.</strong> {words.stateHint[state]}
              {fault && ` ${words.fault}: ${fault}`}
            </>
          ) : (
            words.stateUnknown(words.state[state].toLowerCase())
          )}
        </p>
      )}
    </section>
  );
}
