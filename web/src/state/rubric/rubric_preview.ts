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
    let shown = this.session.peek();
    return effect(() => {
      const [session, wanted] = [this.session.value, rubric()];
      this.stale.value = true;
      // The score of another session must not stand beside this one.
      if (session !== shown) this.score.value = this.problem.value = null;
      shown = session;
      if (session === '' || wanted === null) return undefined;
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
