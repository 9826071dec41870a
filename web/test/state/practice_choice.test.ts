import { beforeEach, describe, expect, it, vi } from 'vitest';

import { beginPractice, PracticeChoice } from '../../src/state/practice_choice';
import type { CaseSummary, Plan, Reamer } from '../../src/wire/rest_types';

const oneCase = (id: string, changes: Partial<CaseSummary> = {}): CaseSummary => ({
  ...{ id, name: `Case ${id}`, side: 'left', stage: 'built', dims: null, spacing_mm: null, planned: true },
  ...changes,
});

const reamer: Reamer = {
  ...{ name: 'convex-30', words: 'sphere 30,14', diameter_mm: 28, radius_mm: 30, nipple: null, cannulated: false },
  description: '',
};

function place(mayRead = true) {
  let cases = [oneCase('demo'), oneCase('a'), oneCase('raw', { stage: 'segmented' }), oneCase('b', { planned: false })];
  const planned = new Map([
    ['demo', 'sphere 30,14'],
    ['a', 'sphere 22'],
  ]);
  const api = {
    cases: vi.fn(() => Promise.resolve(cases)),
    case: vi.fn((id: string) => Promise.resolve({ plan: { reamer: planned.get(id) ?? '' } as Plan })),
    reamers: vi.fn(() => Promise.resolve([reamer])),
  };
  const choice = new PracticeChoice(api, () => mayRead);
  return { api, choice, now: (next: CaseSummary[]) => (cases = next) };
}

const settle = () => new Promise((resolve) => setTimeout(resolve));

describe('What is practised next', () => {
  let disk: Map<string, string>;
  let storage: Pick<Storage, 'getItem' | 'setItem'>;
  beforeEach(() => {
    disk = new Map();
    storage = {
      getItem: (key) => disk.get(key) ?? null,
      setItem: (key, value) => void disk.set(key, value),
    };
  });

  it('is one of the cases that have bone and plan, the demo first', async () => {
    const { choice } = place();
    expect(choice.caseId.value).toBe('demo');
    await choice.read();
    expect(choice.cases.value).toEqual([
      { id: 'demo', name: 'Case demo' },
      { id: 'a', name: 'Case a' },
    ]);
  });

  it('has the demo also while the server still prepares it', async () => {
    const { choice, now } = place();
    now([oneCase('a', { name: '' })]);
    await choice.read();
    expect(choice.cases.value).toEqual([
      { id: 'demo', name: 'demo' },
      { id: 'a', name: 'a' },
    ]);
  });

  it('stays what it was while the cases cannot be read, and is the demo once the case is gone', async () => {
    const { choice, api, now } = place();
    choice.choose('a');
    await choice.read();
    expect(choice.caseId.value).toBe('a');
    api.cases.mockRejectedValueOnce(new Error('no answer'));
    await choice.read();
    expect(choice.cases.value).toHaveLength(2);
    now([oneCase('demo')]);
    await choice.read();
    expect(choice.caseId.value).toBe('demo');
  });

  it('is always the demo for who may not read cases, and nothing is asked', async () => {
    const { choice, api } = place(false);
    choice.choose('a');
    await choice.read();
    expect(choice.caseId.value).toBe('demo');
    expect(choice.cases.value).toBeNull();
    expect(api.cases).not.toHaveBeenCalled();
  });

  it('is remembered for each person', () => {
    const { choice } = place();
    const end = choice.keepFor('anna', storage);
    choice.choose('a');
    choice.level.value = 'own';
    end();
    const endTom = choice.keepFor('tom', storage);
    expect([choice.caseId.value, choice.level.value]).toEqual(['demo', 'guided']);
    endTom();
    choice.keepFor('anna', storage)();
    expect([choice.caseId.value, choice.level.value]).toEqual(['a', 'own']);
  });

  it.each(['no JSON', 'null', '{"level":"none","caseId":7}'])('is as at the first time when %s was kept', (kept) => {
    disk.set('ream.practice.anna', kept);
    const { choice } = place();
    choice.keepFor('anna', storage)();
    expect([choice.caseId.value, choice.level.value]).toEqual(['demo', 'guided']);
  });

  it('says the reamer of the plan by its name, else in its words', async () => {
    const { choice, api } = place();
    const stop = choice.followReamer();
    await settle();
    expect(choice.reamer.value).toBeNull();
    await choice.read();
    await settle();
    expect(choice.reamer.value).toMatchObject({ name: 'convex-30', diameter_mm: 28 });
    await choice.read();
    expect(choice.reamer.value).not.toBeNull();
    expect(api.case).toHaveBeenCalledTimes(1);
    choice.choose('a');
    expect(choice.reamer.value).toBeNull();
    await settle();
    expect(choice.reamer.value).toBe('sphere 22');
    stop();
  });

  it('begins on the chosen case at the chosen level, in theatre only in the exam', async () => {
    const { choice } = place();
    const watcher = { practise: vi.fn((): Promise<string | null> => Promise.resolve('s1')) };
    const practice = { steer: vi.fn() };
    choice.level.value = 'free';
    await beginPractice({ watcher, practice, choice });
    expect(watcher.practise).toHaveBeenLastCalledWith('demo', false);
    expect(practice.steer).toHaveBeenLastCalledWith('s1', 'free');
    choice.level.value = 'exam';
    await beginPractice({ watcher, practice, choice }, 'a');
    expect(watcher.practise).toHaveBeenLastCalledWith('a', true);
    expect(choice.caseId.value).toBe('a');
    watcher.practise.mockResolvedValueOnce(null);
    practice.steer.mockClear();
    expect(await beginPractice({ watcher, practice, choice }, 'b')).toBeNull();
    expect(practice.steer).not.toHaveBeenCalled();
    expect(choice.caseId.value).toBe('a');
  });
});
