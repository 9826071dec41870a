import { signal } from '@preact/signals';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { ResultWatch } from '../../src/state/result_watch';
import { Store } from '../../src/state/store';
import { ApiError } from '../../src/wire/rest';
import type { Score, Session } from '../../src/wire/rest_types';
import { someSession } from '../wire/some_answers';

const some = (id: string) => ({ session: id, points: 80 }) as Score;

function place(score: (id: string) => Promise<Score> = (id) => Promise.resolve(some(id))) {
  const store = new Store();
  const hidden = signal(false);
  const ask = vi.fn(score);
  const watch = new ResultWatch({ store, score: ask, hidden });
  const at = (state: Session['state'], id = 's1') => {
    store.sessionId.value = id;
    store.details.value = someSession({ id, state });
    store.sessionState.value = state;
  };
  return { store, hidden, ask, watch, at };
}

const settle = () => vi.advanceTimersByTimeAsync(0);
beforeEach(() => vi.useFakeTimers());
afterEach(() => vi.useRealTimers());

describe('the result of the watched session', () => {
  it('is shown when the session ends, asked for once, and goes when another one begins', async () => {
    const { watch, at, ask } = place();
    at('running');
    expect(watch.shown.value).toBeNull();
    at('stopped');
    expect(watch.shown.value).toBe('s1');
    expect(watch.result.value).toBeNull();
    await settle();
    expect(watch.result.value).toEqual({ kind: 'score', score: some('s1') });
    at('running', 's2');
    expect(watch.shown.value).toBeNull();
    expect(watch.result.value).toBeNull();
    at('finished', 's2');
    await settle();
    expect(watch.result.value).toEqual({ kind: 'score', score: some('s2') });
    expect(ask.mock.calls).toEqual([['s1'], ['s2']]);
  });

  it('stays away once closed, until it is asked for', async () => {
    const { watch, at, ask } = place();
    at('paused');
    at('finished');
    await settle();
    watch.close();
    expect(watch.shown.value).toBeNull();
    at('finished');
    expect(watch.shown.value).toBeNull();
    watch.show();
    expect(watch.shown.value).toBe('s1');
    expect(watch.result.value?.kind).toBe('score');
    expect(ask).toHaveBeenCalledTimes(1);
  });

  it('is not shown unasked of a session that ended before, nor of a recording, nor of a fault', async () => {
    const { watch, at, store, ask } = place();
    at('finished');
    expect(watch.shown.value).toBeNull();
    expect(watch.ended.value).toBe('s1');
    at('running', 's2');
    at('fault', 's2');
    expect(watch.ended.value).toBeNull();
    at('running', 's3');
    store.replayId.value = 'r1';
    at('stopped', 's3');
    expect(watch.ended.value).toBeNull();
    await settle();
    expect(ask).not.toHaveBeenCalled();
  });

  it('is not even asked for where a study hides it', async () => {
    const { watch, at, hidden, ask } = place();
    at('running');
    hidden.value = true;
    at('stopped');
    await settle();
    expect(watch.ended.value).toBeNull();
    expect(ask).not.toHaveBeenCalled();
  });

  it('does not come where the server withholds it', async () => {
    for (const status of [403, 404]) {
      const { watch, at } = place(() => Promise.reject(new ApiError('hidden', status)));
      at('running');
      at('stopped');
      await settle();
      expect(watch.shown.value).toBeNull();
      expect(watch.ended.value).toBeNull();
    }
  });

  it('is asked for again while the server has none, and then says so', async () => {
    let answers = 0;
    const { watch, at } = place(() =>
      ++answers < 3 ? Promise.reject(new ApiError('busy', 503)) : Promise.resolve(some('s1')),
    );
    at('running');
    at('stopped');
    await vi.advanceTimersByTimeAsync(10_000);
    expect(watch.result.value?.kind).toBe('score');

    const never = place(() => Promise.reject(new ApiError('nothing was recorded', 409)));
    never.at('running');
    never.at('stopped');
    await vi.advanceTimersByTimeAsync(60_000);
    expect(never.watch.result.value).toEqual({ kind: 'failed', reason: 'nothing was recorded' });
  });
});
