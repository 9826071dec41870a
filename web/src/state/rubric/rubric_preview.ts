import { effect, signal } from '@preact/signals';

import type { Rubric, Score } from '../../wire/rest_types';
import { messageOf } from '../../wire/rest';

interface PreviewApi {
  preview(session: string, rubric: Rubric, signal: AbortSignal): Promise<Score>;
}

/** What a chosen session is worth by the rubric as it stands; asked for anew when that has rested. */
export class RubricPreview {
  /** Empty: none is chosen. */
  readonly session = signal('');
  readonly score = signal<Score | null>(null);
  readonly problem = signal<string | null>(null);
  /** The score is of an earlier state of the rubric. */
  readonly stale = signal(false);

  constructor(
    private readonly api: PreviewApi,
    private readonly restMs = 300,
  ) {}

  /** Until what it gives is called. `rubric`: null while it cannot be used. */
  follow(rubric: () => Rubric | null): () => void {
    return effect(() => {
      const [session, wanted] = [this.session.value, rubric()];
      this.stale.value = true;
      // What was said of another session is not left beside this one's name.
      if (this.score.peek()?.session !== session) this.score.value = null;
      this.problem.value = null;
      if (session === '') return undefined;
      if (wanted === null) return undefined;
      const giveUp = new AbortController();
      const timer = setTimeout(() => void this.ask(session, wanted, giveUp.signal), this.restMs);
      return () => {
        clearTimeout(timer);
        giveUp.abort();
      };
    });
  }

  private async ask(session: string, rubric: Rubric, signal: AbortSignal): Promise<void> {
    try {
      const score = await this.api.preview(session, rubric, signal);
      if (signal.aborted) return;
      this.score.value = score;
      this.problem.value = null;
      this.stale.value = false;
    } catch (error) {
      if (!signal.aborted) this.problem.value = messageOf(error);
    }
  }
}
