import { signal } from '@preact/signals';
import { describe, expect, it, vi } from 'vitest';

import type { LevelName } from '../../src/practice/level';
import { beginNext, goesOnInStudy, nextSession } from '../../src/state/next_session';
import { permissionsOf } from '../../src/state/permissions';
import type { Session } from '../../src/wire/rest_types';
import { someDevice, someSession } from '../wire/some_answers';

const trainee = { may: permissionsOf('trainee'), steeredLast: 'abcd' };
const instructor = { may: permissionsOf('instructor'), steeredLast: null };
const viewer = { may: permissionsOf('viewer'), steeredLast: null };
const ended = (changes: Partial<Session> = {}) =>
  someSession({ state: 'stopped', case: 'real', theatre: true, device: someDevice('browser'), ...changes });

describe('what comes after a session', () => {
  it('is the same again for who reamed, practice for who watched, nothing for who only looks', () => {
    expect(nextSession(ended(), trainee)).toBe('again');
    expect(nextSession(ended(), instructor)).toBe('practise');
    expect(nextSession(ended(), viewer)).toBeNull();
    expect(nextSession(ended({ device: someDevice('script') }), trainee)).toBe('practise');
    expect(nextSession(ended({ device: someDevice('inverse3') }), instructor)).toBe('again');
  });

  it('is the next one of the study for who takes part, and nothing in a participant’s place', () => {
    const inStudy = ended({ study: 'st1', participant: 'P-01' });
    expect(nextSession(inStudy, trainee)).toBe('attempt');
    expect(nextSession(inStudy, instructor)).toBe('practise');
    expect(nextSession({ ...inStudy, device: someDevice('inverse3') }, instructor)).toBe('practise');
    expect(goesOnInStudy({ ...inStudy, state: 'created' }, trainee)).toBe(false);
    expect(goesOnInStudy(null, trainee)).toBe(false);
  });

  it('is on the same case and at the same level, in the hand of this page', async () => {
    const watcher = {
      practise: vi.fn(() => Promise.resolve('next')),
      repeat: vi.fn(() => Promise.resolve('next')),
      train: vi.fn(() => Promise.resolve(ended({ id: 'next' }))),
    };
    let level: LevelName = 'exam';
    const practice = { steer: vi.fn(), levelOf: () => level };
    const choice = { caseId: signal('demo'), level: signal<LevelName>('free'), choose: vi.fn() };
    const means = { watcher, practice, choice, may: permissionsOf('trainee') };
    await beginNext('again', ended(), means);
    expect(watcher.practise).toHaveBeenLastCalledWith('real', true);
    expect(practice.steer).toHaveBeenLastCalledWith('next', 'exam');
    level = 'own';
    await beginNext('again', ended({ theatre: false }), means);
    expect(watcher.practise).toHaveBeenLastCalledWith('real', false);
    expect(practice.steer).toHaveBeenLastCalledWith('next', 'own');
    // What somebody else reamed is practised as one has chosen oneself.
    await beginNext('practise', ended(), means);
    expect(watcher.practise).toHaveBeenLastCalledWith('real', false);
    expect(practice.steer).toHaveBeenLastCalledWith('next', 'free');
    expect(choice.choose).toHaveBeenLastCalledWith('real');
    practice.steer.mockClear();
    await beginNext('again', ended({ device: someDevice('inverse3') }), means);
    expect(watcher.repeat).toHaveBeenLastCalledWith('abcd');
    expect(practice.steer).not.toHaveBeenCalled();
    await beginNext('attempt', ended({ study: 'st1', participant: 'P-01' }), means);
    expect(watcher.train).toHaveBeenLastCalledWith('st1', null, 'real');
    expect(practice.steer).toHaveBeenLastCalledWith('next');
  });
});
