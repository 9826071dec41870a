import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { LiveAnnotations } from '../../src/state/live_annotations';
import { Store } from '../../src/state/store';
import type { Annotation } from '../../src/wire/rest_types';
import { telemetry } from '../wire/fake_messages';
import { someAnnotation } from '../wire/some_answers';

const annotation = someAnnotation;

/** Keeps remarks as the server does. */
class FakeApi {
  readonly kept = new Map<string, Annotation[]>();
  down = false;
  annotations(id: string): Promise<Annotation[]> {
    if (this.down) return Promise.reject(new Error('no answer'));
    return Promise.resolve([...(this.kept.get(id) ?? [])]);
  }
  annotate(id: string, text: string, atS: number): Promise<Annotation> {
    if (this.down) return Promise.reject(new Error('no answer'));
    const made = annotation(atS, text);
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
  return { store, api, annotations: new LiveAnnotations(store, api) };
}

const settle = () => vi.advanceTimersByTimeAsync(0);
beforeEach(() => vi.useFakeTimers());
afterEach(() => vi.useRealTimers());

describe('LiveRemarks', () => {
  it('keeps a remark at the moment at which writing began', async () => {
    const { store, api, annotations } = place();
    at(store, 4000);
    annotations.begin();
    at(store, 9000);
    annotations.begin();
    expect(annotations.momentS.value).toBe(4);
    expect(await annotations.keep('Leans too far back')).toBe(true);
    expect(api.kept.get('s1')).toEqual([annotation(4, 'Leans too far back')]);
    expect(annotations.annotations.value.map((r) => r.words)).toEqual(['Leans too far back']);
    expect(annotations.momentS.value).toBeNull();
  });

  it('says what went wrong, and keeps the moment for another try', async () => {
    const { store, api, annotations } = place();
    at(store, 4000);
    annotations.begin();
    api.down = true;
    expect(await annotations.keep('Too hard')).toBe(false);
    expect(annotations.problem.value).toBe('no answer');
    api.down = false;
    at(store, 8000);
    expect(await annotations.keep('Too hard')).toBe(true);
    expect(api.kept.get('s1')).toEqual([annotation(4, 'Too hard')]);
  });

  it('hears of what others remark, while the session goes on', async () => {
    const { api, annotations } = place();
    await settle();
    const stop = annotations.follow();
    api.kept.set('s1', [annotation(1, 'first'), annotation(2, 'second')]);
    await vi.advanceTimersByTimeAsync(5000);
    expect(annotations.annotations.value.map((r) => r.words)).toEqual(['second', 'first']);
    stop();
  });

  it('never shows the remarks of another session', async () => {
    const { store, api, annotations } = place();
    api.kept.set('s1', [annotation(1, 'of the first')]);
    store.sessionState.value = 'paused';
    await settle();
    expect(annotations.annotations.value).toHaveLength(1);
    api.down = true;
    store.sessionId.value = 's2';
    expect(annotations.annotations.value).toEqual([]);
    await settle();
    expect(annotations.annotations.value).toEqual([]);
  });
});
