import { beforeEach, describe, expect, it } from 'vitest';

import { AnswerSheet, sectionsOf } from '../../../src/state/study/answer_sheet';
import type { QuestionnaireItem, Questionnaire } from '../../../src/wire/rest_types';

const likert = (id: string, section: string): QuestionnaireItem => ({
  kind: 'likert',
  id,
  section,
  words: id,
  required: true,
  points: 5,
  low: 'no',
  middle: '',
  high: 'yes',
  cannot_judge: true,
});
const questionnaire: Questionnaire = {
  id: 'q',
  title: 'Q',
  introduction: '',
  language: 'en',
  items: [
    likert('force', 'Felt'),
    likert('sound', 'Heard'),
    {
      kind: 'choice',
      id: 'tools',
      section: 'Heard',
      words: 'tools',
      required: true,
      options: [
        { id: 'saw', words: 'Saw' },
        { id: 'drill', words: 'Drill' },
      ],
      several: true,
    },
    { kind: 'text', id: 'remarks', section: '', words: 'remarks', required: false, longest: 5 },
  ],
};

class Memory {
  kept = new Map<string, string>();
  getItem = (key: string) => this.kept.get(key) ?? null;
  setItem = (key: string, value: string) => void this.kept.set(key, value);
  removeItem = (key: string) => void this.kept.delete(key);
}

describe('AnswerSheet', () => {
  let memory: Memory;
  let sheet: AnswerSheet;
  const missing = () => sheet.missing.value.map((item) => item.id);

  beforeEach(() => {
    memory = new Memory();
    sheet = new AnswerSheet(questionnaire, memory, 'key', null);
  });

  it('knows what is missing; cannot judge is an answer', () => {
    expect(missing()).toEqual(['force', 'sound', 'tools']);
    sheet.set('force', 4);
    sheet.set('sound', null);
    expect(missing()).toEqual(['tools']);
    expect(sheet.answered.value).toBe(2);
    sheet.toggle('tools', 'drill');
    expect(missing()).toEqual([]);
    sheet.toggle('tools', 'drill');
    expect(missing()).toEqual(['tools']);
    sheet.set('force', undefined);
    expect(missing()).toEqual(['force', 'tools']);
  });

  it('counts characters of a text, not its code units', () => {
    for (const item of ['force', 'sound']) sheet.set(item, 1);
    sheet.toggle('tools', 'saw');
    sheet.set('remarks', '😀😀😀😀😀');
    expect(missing()).toEqual([]);
    sheet.set('remarks', '😀😀😀😀😀!');
    expect(missing()).toEqual(['remarks']);
  });

  it('keeps a draft over a reload of the page until it is sent', () => {
    sheet.set('force', 2);
    const again = new AnswerSheet(questionnaire, memory, 'key', { force: 5, sound: 5 });
    expect(again.answers.value).toEqual({ force: 2 });
    again.sent();
    expect(new AnswerSheet(questionnaire, memory, 'key', { force: 5 }).answers.value).toEqual({ force: 5 });
  });

  it('forgets drafts that are of another questionnaire or damaged', () => {
    memory.setItem('key', JSON.stringify({ force: 3, gone: 1 }));
    expect(new AnswerSheet(questionnaire, memory, 'key', null).answers.value).toEqual({ force: 3 });
    memory.setItem('key', '{');
    expect(new AnswerSheet(questionnaire, memory, 'key', null).answers.value).toEqual({});
  });
});

describe('sectionsOf', () => {
  it('puts neighbours under one heading', () => {
    expect(sectionsOf(questionnaire).map(({ section, items }) => [section, items.length])).toEqual([
      ['Felt', 1],
      ['Heard', 2],
      ['', 1],
    ]);
  });
});
