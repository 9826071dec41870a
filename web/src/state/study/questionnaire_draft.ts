import { computed, signal } from '@preact/signals';

import { questionnaireText } from '../../text/questionnaire_text';
import type { ChoiceItem, NewQuestionnaireItem, Questionnaire, QuestionnaireItem } from '../../wire/rest_types';

export type ItemKind = QuestionnaireItem['kind'];
export type ChoiceOption = ChoiceItem['options'][number];
/** A question with what tells it from others as long as the form is open. */
export interface ItemDraft {
  key: number;
  item: QuestionnaireItem;
}

const idPattern = /^[a-z][a-z0-9_]{0,63}$/;
const longestAnswer = 10_000;

/** A study's own questionnaire while it is written. */
export class QuestionnaireDraft {
  readonly id = signal('questions');
  readonly title = signal('');
  readonly introduction = signal('');
  readonly items = signal<readonly ItemDraft[]>([]);
  private language = 'en';
  private nextKey = 0;

  /** As it would be sent, whether it is complete or not. */
  readonly questionnaire = computed<Questionnaire>(() => ({
    id: this.id.value,
    title: this.title.value.trim(),
    introduction: this.introduction.value.trim(),
    language: this.language,
    items: this.items.value.map(({ item }) => item),
  }));
  /** What is wrong by place: "title", "2/words", "2/options/0". */
  readonly faults = computed(() => faultsOf(this.questionnaire.value));

  /** Takes what a file holds; throws an Error with words where that is no questionnaire. */
  load(value: unknown): void {
    if (!isQuestionnaire(value)) throw new Error(questionnaireText.notOne);
    this.language = value.language ?? 'en';
    this.id.value = value.id;
    this.title.value = value.title;
    this.introduction.value = value.introduction ?? '';
    this.items.value = value.items.map((item) => ({ key: this.nextKey++, item: complete(item) }));
  }

  /** Gives the key of the new question. */
  add(kind: ItemKind): number {
    const key = this.nextKey++;
    const taken = this.items.value.map(({ item }) => item.id);
    this.items.value = [...this.items.value, { key, item: blankItem(kind, free('q', taken)) }];
    return key;
  }
  change(key: number, changes: Partial<QuestionnaireItem>): void {
    this.items.value = this.items.value.map((one) =>
      one.key === key ? { key, item: { ...one.item, ...changes } as QuestionnaireItem } : one,
    );
  }
  remove(key: number): void {
    this.items.value = this.items.value.filter((one) => one.key !== key);
  }
  /** By one place, up (-1) or down (1). */
  move(key: number, by: -1 | 1): void {
    const items = [...this.items.value];
    const from = items.findIndex((one) => one.key === key);
    const [moved, other] = [items[from], items[from + by]];
    if (moved === undefined || other === undefined) return;
    items[from + by] = moved;
    items[from] = other;
    this.items.value = items;
  }
}

/** With an option more, whose name in the data is not taken. */
export const withOption = (options: readonly ChoiceOption[]): ChoiceOption[] => [
  ...options,
  {
    id: free(
      'o',
      options.map(({ id }) => id),
    ),
    words: '',
  },
];

/** "q3": the first number that is free. */
function free(letter: string, taken: readonly string[]): string {
  for (let number = 1; ; ++number) if (!taken.includes(`${letter}${number}`)) return `${letter}${number}`;
}

function blankItem(kind: ItemKind, id: string): QuestionnaireItem {
  switch (kind) {
    case 'likert':
      return complete({ id, kind, words: '', points: 5 });
    case 'choice':
      return complete({ id, kind, words: '', options: withOption(withOption([])) });
    case 'text':
      return complete({ id, kind, words: '' });
  }
}

/** With every default written out, as the server does. */
function complete(item: NewQuestionnaireItem): QuestionnaireItem {
  const section = item.section ?? '';
  switch (item.kind) {
    case 'likert': {
      const ends = { low: 'Strongly disagree', middle: '', high: 'Strongly agree' };
      return { ...ends, cannot_judge: false, required: true, ...item, section };
    }
    case 'choice':
      return { several: false, required: true, ...item, section };
    case 'text':
      return { longest: 2000, required: false, ...item, section };
  }
}

type Loaded = Pick<Questionnaire, 'id' | 'title'> & {
  introduction?: string;
  language?: string;
  items: NewQuestionnaireItem[];
};

/** Enough of one to be shown; the rest is said beside the fields, or by the server. */
function isQuestionnaire(value: unknown): value is Loaded {
  const { id, title, introduction, items } = (value ?? {}) as Record<string, unknown>;
  if (typeof id !== 'string' || typeof title !== 'string' || !isWords(introduction) || !Array.isArray(items))
    return false;
  return items.every((item: unknown) => {
    const { id, kind, words, options, section, low, middle, high } = (item ?? {}) as Record<string, unknown>;
    const known = typeof id === 'string' && typeof words === 'string' && [section, low, middle, high].every(isWords);
    return known && (kind === 'likert' || kind === 'text' || (kind === 'choice' && isOptions(options)));
  });
}

const isWords = (value: unknown): boolean => value === undefined || typeof value === 'string';

const isOptions = (value: unknown): boolean =>
  Array.isArray(value) &&
  value.every((option: unknown) => {
    const { id, words } = (option ?? {}) as Record<string, unknown>;
    return typeof id === 'string' && typeof words === 'string';
  });

function faultsOf({ id, title, items }: Questionnaire): ReadonlyMap<string, string> {
  const faults = new Map<string, string>();
  const { needed, badId, noQuestions } = questionnaireText;
  if (title === '') faults.set('title', needed);
  if (!idPattern.test(id)) faults.set('id', badId);
  if (items.length === 0) faults.set('items', noQuestions);
  items.forEach((item, i) => {
    const before = items.slice(0, i).map((one) => one.id);
    for (const [field, words] of faultsOfItem(item, before)) faults.set(`${i}/${field}`, words);
  });
  return faults;
}

function faultsOfItem(item: QuestionnaireItem, before: readonly string[]): [string, string][] {
  const { needed, badId, twice, twoOptions, badLongest } = questionnaireText;
  const faults: [string, string][] = [];
  if (item.words.trim() === '') faults.push(['words', needed]);
  if (!idPattern.test(item.id)) faults.push(['id', badId]);
  else if (before.includes(item.id)) faults.push(['id', twice]);
  if (item.kind === 'likert')
    for (const end of ['low', 'high'] as const) if (item[end].trim() === '') faults.push([end, needed]);
  if (item.kind === 'choice') {
    if (item.options.length < 2) faults.push(['options', twoOptions]);
    item.options.forEach(({ words }, i) => {
      if (words.trim() === '') faults.push([`options/${i}`, needed]);
    });
  }
  if (item.kind === 'text' && !(Number.isInteger(item.longest) && item.longest > 0 && item.longest <= longestAnswer))
    faults.push(['longest', badLongest]);
  return faults;
}
