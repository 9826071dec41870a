import { signal } from '@preact/signals';

import { DesignDraft } from './design_draft';
import { FeelDraft } from './feel_draft';
import { QuestionnaireDraft } from './questionnaire_draft';
import { studyText } from '../../text/study_text';
import { messageOf } from '../../wire/rest';
import type { NewStudy } from '../../wire/rest_types';

/** Whose questionnaire a study asks. */
export type QuestionnaireChoice = 'ours' | 'none' | 'own';

/** A study as it is being filled in. */
export class StudyDraft {
  readonly name = signal('');
  readonly description = signal('');
  readonly cases = signal<readonly string[]>(['demo']);
  /** Empty: the server's usual one. */
  readonly device = signal('browser');
  readonly design = new DesignDraft();
  /** Where it is used, the study has neither cases nor design nor raters. */
  readonly feel = new FeelDraft();
  /** Raters fill in the form that comes with the program; else nobody rates. */
  readonly rated = signal(true);
  readonly questionnaireChoice = signal<QuestionnaireChoice>('ours');
  /** Written here, or from a file. */
  readonly questionnaire = new QuestionnaireDraft();
  /** Why the questionnaire's file cannot be used, or the study not be made. */
  readonly problem = signal<string | null>(null);

  get complete(): boolean {
    const answerable = this.questionnaireChoice.value !== 'own' || this.questionnaire.faults.value.size === 0;
    if (this.feel.used.value) return answerable && this.feel.complete;
    return answerable && this.design.complete && this.cases.value.length > 0;
  }

  /** There are questions that would be lost. */
  get questionnaireWritten(): boolean {
    return this.questionnaireChoice.peek() === 'own' && this.questionnaire.items.peek().length > 0;
  }

  toggleCase(id: string): void {
    const chosen = this.cases.value;
    this.cases.value = chosen.includes(id) ? chosen.filter((one) => one !== id) : [...chosen, id];
  }

  async readQuestionnaire(file: File | undefined): Promise<void> {
    this.problem.value = null;
    if (file === undefined) return;
    let content: unknown;
    try {
      content = JSON.parse(await file.text());
    } catch {
      this.problem.value = studyText.fileUnreadable;
      return;
    }
    try {
      this.questionnaire.load(content);
    } catch (error) {
      this.problem.value = messageOf(error);
    }
  }

  /** What the server is asked for. */
  study(): NewStudy {
    const questionnaireChoice = this.questionnaireChoice.value;
    return {
      name: this.name.value.trim(),
      description: this.description.value.trim(),
      ...(this.device.value === '' ? {} : { device: this.device.value }),
      ...(questionnaireChoice === 'ours' ? {} : { questionnaire: questionnaireChoice === 'none' ? null : this.own() }),
      ...(this.feel.used.value ? { feel: this.feel.feel(), rating_form: null } : this.ofScores()),
    };
  }

  /** The server takes it as it is: nothing of it is left out. */
  private own(): NewStudy['questionnaire'] {
    return this.questionnaire.questionnaire.value;
  }

  private ofScores(): Pick<NewStudy, 'cases' | 'design' | 'rating_form'> {
    const design = this.design.design();
    return {
      cases: [...this.cases.value],
      ...(design === null ? {} : { design }),
      ...(this.rated.value ? {} : { rating_form: null }),
    };
  }
}
