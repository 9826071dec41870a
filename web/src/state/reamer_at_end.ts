import { effect, untracked } from '@preact/signals';

import type { Store } from './store';

const over = ['finished', 'stopped', 'fault', 'interrupted'];

/** Lays the reamer aside when a session has ended, so that the bone is seen as it was left; until the next one. */
export function layReamerAside(store: Store): void {
  let aside = false;
  effect(() => {
    const ended = !store.replaying.value && over.includes(store.sessionState.value ?? '');
    untracked(() => {
      if (ended === aside || (ended && !store.reamerShown.value)) return;
      aside = ended;
      store.reamerShown.value = !ended;
    });
  });
}
