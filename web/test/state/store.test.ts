import { describe, expect, it } from 'vitest';

import { Store } from '../../src/state/store';
import { telemetry } from '../wire/fake_messages';

describe('the store', () => {
  it('has nothing to read of a reamer that nobody holds, and keeps what it did to the bone', () => {
    const store = new Store();
    const message = telemetry({ tick: 100, handForceN: 3.66, removedVolumeMm3: 20 });
    if (message.kind === 'telemetry') store.telemetry.value = message.telemetry;
    store.sessionState.value = 'running';
    expect(store.atReamer.value?.handForceN).toBeCloseTo(3.66, 5);
    store.sessionState.value = 'paused';
    expect(store.atReamer.value).not.toBeNull();
    for (const state of ['created', 'stopped', 'finished', 'fault', 'interrupted'] as const) {
      store.sessionState.value = state;
      expect(store.atReamer.value, state).toBeNull();
      expect(store.reading.value.telemetry?.removedVolumeMm3).toBe(20);
    }
    store.replayId.value = 'r1';
    expect(store.atReamer.value).not.toBeNull();
  });
});
