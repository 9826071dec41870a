import type { FeelPlace, PlateName } from '../../wire/rest_types';
import type { StudyApi } from '../../wire/study_api';
import { Remote } from '../remote';

/** For whom staff last ran trials on this page, by study: they come back to it after every session. */
export const lastCodes = new Map<string, string>();

/** Where a participant is in a blind study of feel: which trial is next, and its answer. */
export class TrialPlace {
  readonly place: Remote<FeelPlace>;

  constructor(
    private readonly api: Pick<StudyApi, 'feelTrial' | 'answerFeelTrial'>,
    private readonly studyId: string,
    private readonly code: string,
  ) {
    this.place = new Remote(() => api.feelTrial(studyId, code));
  }

  /** Answers the trial that is shown, once its plates were felt. A refused answer shows which trial is next. */
  async answer(chosen: PlateName): Promise<void> {
    const trial = this.place.value.peek()?.trial ?? null;
    if (trial === null || trial.session === null || this.place.busy.peek()) return;
    const { number } = trial;
    const next = await this.place.act(() => this.answered(number, chosen));
    if (next === null) await this.place.read();
  }

  /** What is next is known from here on, even if it cannot be read anew. */
  private async answered(number: number, chosen: PlateName): Promise<FeelPlace> {
    const next = await this.api.answerFeelTrial(this.studyId, this.code, { number, chosen });
    this.place.value.value = next;
    return next;
  }
}
