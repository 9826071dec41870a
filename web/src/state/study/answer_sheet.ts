import { computed, signal } from '@preact/signals';

import type { Answer, GivenAnswers, QuestionnaireItem, Questionnaire } from '../../wire/rest_types';

/** What one participant answers, while it is filled in. */
export class AnswerSheet {
  readonly answers = signal<GivenAnswers>({});
  /** Whether sending was tried, so that what is missing is shown. */
  readonly tried = signal(false);

  /** Items that have to be answered and are not, or not as they may be, in order. */
  readonly missing = computed(() =>
    this.questionnaire.items.filter((item) => !isAnswered(item, this.answers.value[item.id])),
  );
  readonly answered = computed(() => this.requiredItems.filter((item) => isGiven(this.answers.value[item.id])).length);
  /** Items that have to be answered. */
  readonly requiredItems: readonly QuestionnaireItem[];

  constructor(
    readonly questionnaire: Questionnaire,
    private readonly remembered: Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>,
    /** Under which a draft is remembered while the page is open. */
    private readonly key: string,
    given: GivenAnswers | null,
  ) {
    this.requiredItems = questionnaire.items.filter((item) => item.required);
    this.answers.value = this.draft() ?? given ?? {};
  }

  /** `undefined` takes an answer back. */
  set(id: string, answer: Answer | undefined): void {
    const answers = { ...this.answers.value };
    if (answer === undefined) delete answers[id];
    else answers[id] = answer;
    this.answers.value = answers;
    this.remembered.setItem(this.key, JSON.stringify(answers));
  }

  /** Of a choice of several: puts an option in or takes it out. */
  toggle(id: string, option: string): void {
    const before = this.answers.value[id];
    const chosen = Array.isArray(before) ? before : [];
    this.set(id, chosen.includes(option) ? chosen.filter((one) => one !== option) : [...chosen, option]);
  }

  /** The server has them: the draft is of no more use. */
  sent(): void {
    this.remembered.removeItem(this.key);
  }

  private draft(): GivenAnswers | null {
    try {
      const kept = JSON.parse(this.remembered.getItem(this.key) ?? 'null') as GivenAnswers | null;
      const known = new Set(this.questionnaire.items.map((item) => item.id));
      return kept === null ? null : Object.fromEntries(Object.entries(kept).filter(([id]) => known.has(id)));
    } catch {
      return null;
    }
  }
}

function isGiven(answer: Answer | undefined): boolean {
  return answer !== undefined && answer !== '' && !(Array.isArray(answer) && answer.length === 0);
}

function isAnswered(item: QuestionnaireItem, answer: Answer | undefined): boolean {
  if (item.kind === 'text' && typeof answer === 'string' && [...answer].length > item.longest) return false;
  return !item.required || isGiven(answer);
}

/** Items that stand together under a heading, in order. */
export function sectionsOf(questionnaire: Questionnaire): { section: string; items: QuestionnaireItem[] }[] {
  const sections: { section: string; items: QuestionnaireItem[] }[] = [];
  for (const item of questionnaire.items) {
    const last = sections.at(-1);
    if (last?.section === item.section) last.items.push(item);
    else sections.push({ section: item.section, items: [item] });
  }
  return sections;
}
