import { signal } from '@preact/signals';
import { expect, it, vi } from 'vitest';

import { RubricPreview } from '../../../src/state/rubric/rubric_preview';
import type { Rubric, Score } from '../../../src/wire/rest_types';

const rubric = (name: string): Rubric => ({ name, version: 1, criteria: [{ metric: 'passes' }] });

it('follows session and rubric; of two answers the later question counts', async () => {
  const asked: { rubric: Rubric; answer: (score: Score) => void; signal: AbortSignal }[] = [];
  const preview = new RubricPreview(
    {
      preview: (_session, wanted, signal) => new Promise((answer) => asked.push({ rubric: wanted, answer, signal })),
    },
    0,
  );
  const draft = signal<Rubric | null>(rubric('A'));
  const end = preview.follow(() => draft.value);
  preview.session.value = 's1';
  await vi.waitFor(() => expect(asked).toHaveLength(1));
  draft.value = rubric('B');
  await vi.waitFor(() => expect(asked).toHaveLength(2));
  expect(asked[0]?.signal.aborted).toBe(true);
  asked[1]?.answer({ session: 's1', points: 2 } as Score);
  asked[0]?.answer({ session: 's1', points: 1 } as Score);
  await vi.waitFor(() => expect(preview.score.value?.points).toBe(2));
  expect(preview.stale.value).toBe(false);
  draft.value = null;
  expect(preview.stale.value).toBe(true);
  expect(preview.score.value?.points).toBe(2);
  draft.value = rubric('C');
  await vi.waitFor(() => expect(asked).toHaveLength(3));
  preview.session.value = 's2';
  expect(preview.score.value).toBeNull();
  asked[2]?.answer({ points: 3 } as Score);
  await vi.waitFor(() => expect(asked).toHaveLength(4));
  expect(preview.score.value).toBeNull();
  preview.session.value = '';
  end();
  expect(asked).toHaveLength(4);
});

it('says why there is none', async () => {
  const preview = new RubricPreview({ preview: () => Promise.reject(new Error('gone')) }, 0);
  preview.session.value = 's1';
  const end = preview.follow(() => rubric('A'));
  await vi.waitFor(() => expect(preview.problem.value).toBe('gone'));
  preview.session.value = 's2';
  expect(preview.problem.value).toBeNull();
  end();
});
