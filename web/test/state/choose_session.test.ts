import { describe, expect, it } from 'vitest';

import { canBeReplayed, chooseSession } from '../../src/state/choose_session';
import type { Session } from '../../src/wire/rest_types';
import { someSession } from '../wire/some_answers';

const session = (id: string, state: Session['state'], second: number) =>
  someSession({ id, state, created_utc: `2026-01-01T00:00:0${second}Z` });
const none = new Set<string>();
const watching = (id: string) => ({ id, chosen: false });
const nobody = { id: null, chosen: false };

describe('chooseSession', () => {
  it('asks for a new one when there is none', () => {
    expect(chooseSession([], watching('gone'), none)).toBeUndefined();
  });
  it('takes the newest that runs, not the newest of all', () => {
    const all = [session('a', 'running', 1), session('b', 'running', 2), session('c', 'created', 3)];
    expect(chooseSession(all, nobody, none)?.id).toBe('b');
    expect(chooseSession(all, watching('c'), none)?.id).toBe('b');
  });
  it('leaves those of earlier runs of the server aside', () => {
    const earlier = { ...session('b', 'finished', 2), streamable: false };
    expect(chooseSession([session('a', 'finished', 1), earlier], watching('b'), none)?.id).toBe('a');
    expect(chooseSession([earlier], nobody, none)).toBeUndefined();
  });
  it('stays with a watched session that runs', () => {
    expect(chooseSession([session('a', 'paused', 1), session('b', 'running', 2)], watching('a'), none)?.id).toBe('a');
  });
  it('stays with what is watched when nothing runs', () => {
    expect(chooseSession([session('a', 'finished', 1), session('b', 'created', 2)], watching('a'), none)?.id).toBe('a');
  });
  it('shows the newest when nothing runs, first in the list among equals', () => {
    expect(chooseSession([session('b', 'finished', 2), session('a', 'created', 2)], nobody, none)?.id).toBe('b');
  });
  it('leaves aside what gave no stream', () => {
    expect(
      chooseSession([session('a', 'finished', 1), session('b', 'finished', 2)], watching('b'), new Set(['b']))?.id,
    ).toBe('a');
  });
});

describe('canBeReplayed', () => {
  it('asks for an end and something recorded', () => {
    const can = (state: Session['state'], tick: number) => canBeReplayed({ ...session('a', state, 1), tick });
    expect((['finished', 'stopped', 'fault'] as const).map((state) => can(state, 5))).toEqual([true, true, true]);
    expect((['created', 'running', 'paused'] as const).map((state) => can(state, 5))).toEqual([false, false, false]);
    expect(can('stopped', 0)).toBe(false);
  });
});
