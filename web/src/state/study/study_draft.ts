import { signal } from '@preact/signals';

import { DesignDraft } from './design_draft';
import { FeelDraft } from './feel_draft';
import { studyText } from '../../text/study_text';
import type { NewStudy } from '../../wire/rest_types';

/** Whose questionnaire a study asks. */
export type QuestionnaireChoice = 'ours' | 'none' | 'file';

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
  /** From a file; whether it is one, the server says. */
  readonly questionnaire = signal<NewStudy['questionnaire']>(null);
  /** Why the questionnaire's file cannot be used, or the study not be made. */
  readonly problem = signal<string | null>(null);

  get complete(): boolean {
    const answerable = this.questionnaireChoice.value !== 'file' || this.questionnaire.value !== null;
    if (this.feel.used.value) return answerable && this.feel.complete;
    return answerable && this.design.complete && this.cases.value.length > 0;
  }

  toggleCase(id: string): void {
    const chosen = this.cases.value;
    this.cases.value = chosen.includes(id) ? chosen.filter((one) => one !== id) : [...chosen, id];
  }

  async readQuestionnaire(file: File | undefined): Promise<void> {
    this.questionnaire.value = null;
    this.problem.value = null;
    if (file === undefined) return;
    try {
      this.questionnaire.value = JSON.parse(await file.text()) as NewStudy['questionnaire'];
    } catch {
      this.problem.value = studyText.fileUnreadable;
    }
  }

  /** What the server is asked for. */
  study(): NewStudy {
    const questionnaireChoice = this.questionnaireChoice.value;
    return {
      name: this.name.value.trim(),
      description: this.description.value.trim(),
      ...(this.device.value === '' ? {} : { device: this.device.value }),
      ...(questionnaireChoice === 'ours'
        ? {}
        : { questionnaire: questionnaireChoice === 'none' ? null : this.questionnaire.value }),
      ...(this.feel.used.value ? { feel: this.feel.feel(), rating_form: null } : this.ofScores()),
    };
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
