import { describe, expect, it } from 'vitest';

import { layReamerAside } from '../../src/state/reamer_at_end';
import { Store } from '../../src/state/store';

function place() {
  const store = new Store();
  layReamerAside(store);
  return store;
}

describe('the reamer in the picture', () => {
  it('is laid aside when a session ends, and is there again for the next one and for a replay', () => {
    const store = place();
    for (const end of ['stopped', 'finished', 'fault', 'interrupted'] as const) {
      store.sessionState.value = 'running';
      expect(store.reamerShown.value).toBe(true);
      store.sessionState.value = end;
      expect(store.reamerShown.value, end).toBe(false);
    }
    store.replayId.value = 'r1';
    expect(store.reamerShown.value).toBe(true);
    store.replayId.value = null;
    expect(store.reamerShown.value).toBe(false);
  });

  it('is shown by hand of what has ended, and hidden by hand for as long as somebody wants', () => {
    const store = place();
    store.sessionState.value = 'stopped';
    store.reamerShown.value = true;
    store.sessionState.value = 'finished';
    expect(store.reamerShown.value).toBe(true);
    store.sessionState.value = 'running';
    store.reamerShown.value = false;
    store.sessionState.value = 'stopped';
    store.sessionState.value = 'running';
    expect(store.reamerShown.value).toBe(false);
  });
});
