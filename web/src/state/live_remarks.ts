import { computed, effect, signal } from '@preact/signals';

import type { ReviewApi } from '../wire/review_api';
import { Remote } from './remote';
import type { Store } from './store';
import type { Annotation } from '../wire/rest_types';

/** Others may remark on the same session. */
const readAgainMs = 5000;

/** What is remarked on the watched session, by whoever watches. A replay's remarks are on its review. */
export class LiveRemarks {
  /** The moment that a remark which is being written is about: when writing began, s. Null: nothing is written. */
  readonly momentS = signal<number | null>(null);
  private readonly read: Remote<{ session: string; remarks: Annotation[] }>;

  /** The watched session's, the newest first. */
  readonly remarks = computed((): readonly Annotation[] => {
    const known = this.read.value.value;
    return known === null || known.session !== this.store.sessionId.value ? [] : [...known.remarks].reverse();
  });

  constructor(
    private readonly store: Store,
    private readonly api: Pick<ReviewApi, 'annotations' | 'annotate'>,
  ) {
    this.read = new Remote(async () => {
      const session = store.sessionId.peek() ?? '';
      return { session, remarks: await api.annotations(session) };
    });
    effect(() => {
      this.momentS.value = null;
      if (store.sessionId.value !== null && !store.replaying.value && begun(store)) void this.read.read();
    });
  }

  get problem() {
    return this.read.problem;
  }
  get busy() {
    return this.read.busy;
  }

  /** Reads again and again, until the result is called. */
  follow(): () => void {
    const timer = setInterval(() => {
      const { store } = this;
      if (store.live.peek() && store.active.peek() && !this.busy.peek()) void this.read.read();
    }, readAgainMs);
    return () => clearInterval(timer);
  }

  /** Somebody begins to write: what is written is about this moment. */
  begin(): void {
    this.momentS.value ??= (this.store.telemetry.peek()?.tick ?? 0) / 1000;
  }
  forget(): void {
    this.momentS.value = null;
  }

  /** Whether the remark is kept. */
  async keep(words: string): Promise<boolean> {
    const session = this.store.sessionId.peek();
    if (session === null || words === '') return false;
    this.begin();
    const kept = await this.read.act(() => this.api.annotate(session, words, this.momentS.peek() ?? 0));
    if (kept === null) return false;
    this.momentS.value = null;
    return true;
  }
}

/** A session that nobody has started has no recording to remark on. */
const begun = (store: Store): boolean => store.sessionState.value !== 'created' && store.sessionState.value !== null;
