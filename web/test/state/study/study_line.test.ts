import { describe, expect, it, vi } from 'vitest';

import { Store } from '../../../src/state/store';
import { StudyLine } from '../../../src/state/study/study_line';
import { someSession } from '../../wire/some_answers';

const settle = () => new Promise((resolve) => setTimeout(resolve));
const inStudy = (id: string, changes = {}) => someSession({ id, study: 'st1', participant: 'P03', ...changes });

function place() {
  const store = new Store();
  const study = vi.fn(() => Promise.resolve({ name: 'First year' }));
  const earlier = vi.fn((): Promise<number | null> => Promise.resolve(1));
  const line = new StudyLine({ store, study, earlier });
  const watch = (session = inStudy('a')) => {
    store.sessionId.value = session.id;
    store.details.value = session;
  };
  return { store, study, earlier, line, watch };
}

describe('The line about a study', () => {
  it('has its name, the participant and the attempt in the study', async () => {
    const { line, watch, study } = place();
    expect(line.now.value).toBeNull();
    watch();
    expect(line.now.value).toEqual({ session: 'a', name: null, participant: 'P03', attempt: null });
    await settle();
    expect(line.now.value).toEqual({ session: 'a', name: 'First year', participant: 'P03', attempt: 2 });
    watch(inStudy('a', { tick: 9 }));
    await settle();
    expect(study).toHaveBeenCalledTimes(1);
  });

  it('leaves out what cannot be read, and says nothing of another session', async () => {
    const { line, watch, study, earlier } = place();
    study.mockRejectedValue(new Error('no such study'));
    earlier.mockRejectedValue(new Error('no answer'));
    watch();
    await settle();
    expect(line.now.value).toEqual({ session: 'a', name: null, participant: 'P03', attempt: null });
    watch(someSession({ id: 'b' }));
    expect(line.now.value).toBeNull();
  });

  it('has no attempt for who may not list the sessions', async () => {
    const { line, watch, earlier } = place();
    earlier.mockResolvedValue(null);
    watch();
    await settle();
    expect(line.now.value).toMatchObject({ name: 'First year', attempt: null });
  });

  it('is none of a replay', async () => {
    const { store, line, watch } = place();
    watch();
    await settle();
    store.replayId.value = 'r1';
    expect(line.now.value).toBeNull();
  });
});
