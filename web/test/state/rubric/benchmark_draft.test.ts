import { expect, it } from 'vitest';

import { BenchmarkDraft } from '../../../src/state/rubric/benchmark_draft';

it('needs an expert, and three of each group where there are novices', () => {
  const draft = new BenchmarkDraft();
  draft.name.value = ' Ours ';
  expect(draft.missing.value).not.toBeNull();
  draft.put('e1', 'expert');
  expect(draft.missing.value).toBeNull();
  expect(draft.benchmark()).toEqual({ name: 'Ours', experts: ['e1'] });
  for (const id of ['n1', 'n2', 'n3']) draft.put(id, 'novice');
  expect(draft.missing.value).not.toBeNull();
  for (const id of ['e2', 'e3']) draft.put(id, 'expert');
  draft.put('n3', 'none');
  expect(draft.missing.value).not.toBeNull();
  draft.put('n3', 'novice');
  expect(draft.benchmark()).toEqual({
    name: 'Ours',
    experts: ['e1', 'e2', 'e3'],
    novices: ['n1', 'n2', 'n3'],
    rubric: 'standard',
  });
  draft.clear();
  expect(draft.experts.value).toEqual([]);
});
