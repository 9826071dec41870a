import { readdirSync, readFileSync } from 'node:fs';

import { beforeEach, describe, expect, it } from 'vitest';

import { QuestionnaireDraft, withOption } from '../../../src/state/study/questionnaire_draft';
import { questionnaireText as words } from '../../../src/text/questionnaire_text';
import type { ChoiceItem } from '../../../src/wire/rest_types';

const root = new URL('../../../../', import.meta.url);
const kept = [
  'examples/questionnaire.json',
  ...readdirSync(new URL('proto/questionnaires', root)).map((name) => `proto/questionnaires/${name}`),
];

describe('a questionnaire while it is written', () => {
  let draft: QuestionnaireDraft;
  beforeEach(() => (draft = new QuestionnaireDraft()));

  it.each(kept)('takes %s and says what that says', (path) => {
    const file = JSON.parse(readFileSync(new URL(path, root), 'utf8')) as { items: object[] };
    draft.load(file);
    expect([...draft.faults.value]).toEqual([]);
    expect(draft.questionnaire.value).toMatchObject(file);
    expect(draft.items.value).toHaveLength(file.items.length);
  });

  it('takes nothing else', () => {
    for (const other of [null, 7, [], {}, { id: 'a', title: 'b', items: [{ kind: 'text' }] }])
      expect(() => draft.load(other)).toThrow(words.notOne);
    const broken = [
      { kind: 'choice', options: ['Yes', 'No'] },
      { kind: 'choice', options: [null] },
      { kind: 'likert', low: 5 },
      { kind: 'text', section: 1 },
    ];
    for (const item of broken)
      expect(() => draft.load({ id: 'a', title: 'b', items: [{ id: 'q1', words: 'c', ...item }] })).toThrow(
        words.notOne,
      );
    expect(draft.items.value).toEqual([]);
  });

  it('says beside each field what is missing', () => {
    expect([...draft.faults.value.keys()]).toEqual(['title', 'items']);
    draft.title.value = 'After';
    const [scale, choice, text] = (['likert', 'choice', 'text'] as const).map((kind) => draft.add(kind));
    expect([...draft.faults.value.keys()]).toEqual(['0/words', '1/words', '1/options/0', '1/options/1', '2/words']);
    for (const key of [scale, choice, text]) draft.change(key ?? -1, { words: 'Why?' });
    draft.change(choice ?? -1, { options: [{ id: 'o1', words: 'So' }] });
    draft.change(scale ?? -1, { low: '' });
    draft.change(text ?? -1, { id: 'q1', longest: NaN });
    expect(Object.fromEntries(draft.faults.value)).toEqual({
      '0/low': words.needed,
      '1/options': words.twoOptions,
      '2/id': words.twice,
      '2/longest': words.badLongest,
    });
    draft.change(text ?? -1, { id: 'Q 1' });
    expect(draft.faults.value.get('2/id')).toBe(words.badId);
  });

  it('gives questions and options names that are free', () => {
    const first = draft.add('text');
    draft.add('text');
    draft.remove(first);
    draft.add('text');
    expect(draft.questionnaire.value.items.map(({ id }) => id)).toEqual(['q2', 'q1']);
    const options: ChoiceItem['options'] = withOption([{ id: 'o2', words: '' }]);
    expect(options.map(({ id }) => id)).toEqual(['o2', 'o1']);
  });

  it('moves questions by one place, and not over the ends', () => {
    const keys = (['text', 'text', 'text'] as const).map((kind) => draft.add(kind));
    const order = () => draft.items.value.map(({ key }) => key);
    draft.move(keys[2] ?? -1, -1);
    expect(order()).toEqual([keys[0], keys[2], keys[1]]);
    draft.move(keys[0] ?? -1, -1);
    draft.move(keys[1] ?? -1, 1);
    expect(order()).toEqual([keys[0], keys[2], keys[1]]);
    draft.move(keys[0] ?? -1, 1);
    expect(order()).toEqual([keys[2], keys[0], keys[1]]);
  });
});
