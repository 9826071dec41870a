import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { LiveRemarks } from '../../src/state/live_remarks';
import { Store } from '../../src/state/store';
import type { Annotation } from '../../src/wire/rest_types';
import { telemetry } from '../wire/fake_messages';
import { someAnnotation } from '../wire/some_answers';

const remark = someAnnotation;

/** Keeps remarks as the server does. */
class FakeApi {
  readonly kept = new Map<string, Annotation[]>();
  down = false;
  annotations(id: string): Promise<Annotation[]> {
    if (this.down) return Promise.reject(new Error('no answer'));
    return Promise.resolve([...(this.kept.get(id) ?? [])]);
  }
  annotate(id: string, words: string, atS: number): Promise<Annotation> {
    if (this.down) return Promise.reject(new Error('no answer'));
    const made = remark(atS, words);
    this.kept.set(id, [...(this.kept.get(id) ?? []), made]);
    return Promise.resolve(made);
  }
}

function at(store: Store, tick: number): void {
  const message = telemetry({ tick });
  if (message.kind === 'telemetry') store.telemetry.value = message.telemetry;
}

function place() {
  const store = new Store();
  const api = new FakeApi();
  store.sessionId.value = 's1';
  store.sessionState.value = 'running';
  store.link.value = { kind: 'live' };
  store.pictureComplete.value = true;
  return { store, api, remarks: new LiveRemarks(store, api) };
}

const settle = () => vi.advanceTimersByTimeAsync(0);
beforeEach(() => vi.useFakeTimers());
afterEach(() => vi.useRealTimers());

describe('LiveRemarks', () => {
  it('keeps a remark at the moment at which writing began', async () => {
    const { store, api, remarks } = place();
    at(store, 4000);
    remarks.begin();
    at(store, 9000);
    remarks.begin();
    expect(remarks.momentS.value).toBe(4);
    expect(await remarks.keep('Leans too far back')).toBe(true);
    expect(api.kept.get('s1')).toEqual([remark(4, 'Leans too far back')]);
    expect(remarks.remarks.value.map((r) => r.words)).toEqual(['Leans too far back']);
    expect(remarks.momentS.value).toBeNull();
  });

  it('says what went wrong, and keeps the moment for another try', async () => {
    const { store, api, remarks } = place();
    at(store, 4000);
    remarks.begin();
    api.down = true;
    expect(await remarks.keep('Too hard')).toBe(false);
    expect(remarks.problem.value).toBe('no answer');
    api.down = false;
    at(store, 8000);
    expect(await remarks.keep('Too hard')).toBe(true);
    expect(api.kept.get('s1')).toEqual([remark(4, 'Too hard')]);
  });

  it('hears of what others remark, while the session goes on', async () => {
    const { api, remarks } = place();
    await settle();
    const stop = remarks.follow();
    api.kept.set('s1', [remark(1, 'first'), remark(2, 'second')]);
    await vi.advanceTimersByTimeAsync(5000);
    expect(remarks.remarks.value.map((r) => r.words)).toEqual(['second', 'first']);
    stop();
  });

  it('never shows the remarks of another session', async () => {
    const { store, api, remarks } = place();
    api.kept.set('s1', [remark(1, 'of the first')]);
    store.sessionState.value = 'paused';
    await settle();
    expect(remarks.remarks.value).toHaveLength(1);
    api.down = true;
    store.sessionId.value = 's2';
    expect(remarks.remarks.value).toEqual([]);
    await settle();
    expect(remarks.remarks.value).toEqual([]);
  });
});
