import { computed, effect, type ReadonlySignal, signal } from '@preact/signals';

import { ApiError, messageOf } from '../wire/rest';
import type { Score } from '../wire/rest_types';
import type { Store } from './store';

interface Sources {
  store: Store;
  score: (id: string) => Promise<Score>;
  /** What the session measured must not be seen here. */
  hidden: ReadonlySignal<boolean>;
}

export type Result = { kind: 'score'; score: Score } | { kind: 'failed'; reason: string };

/** A score that is not there at once is asked for so often, this far apart. */
const asksMost = 4;
const askAgainMs = 1500;
/** Said of what somebody may not see. */
const refusals = [401, 403, 404];

/**
 * The result of the watched session once it has ended: shown by itself where this page saw the session under way, else
 * when it is asked for.
 */
export class ResultWatch {
  /** The session that has ended, and whose result may be seen here. */
  readonly ended: ReadonlySignal<string | null>;
  /** The session whose result is shown. */
  readonly shown: ReadonlySignal<string | null>;
  /** Of that session; null: it is asked for. */
  readonly result: ReadonlySignal<Result | null>;
  private readonly open = signal<string | null>(null);
  private readonly withheld = signal<ReadonlySet<string>>(new Set());
  private readonly results = signal<ReadonlyMap<string, Result>>(new Map());
  private readonly asking = new Set<string>();
  private seenActive: string | null = null;

  constructor(private readonly sources: Sources) {
    const { store } = sources;
    this.ended = computed(() => {
      const state = store.sessionState.value;
      const id = store.watched.value?.id ?? null;
      const over = state === 'finished' || state === 'stopped';
      if (id === null || !over || store.replaying.value || sources.hidden.value) return null;
      return this.withheld.value.has(id) ? null : id;
    });
    this.shown = computed(() => (this.ended.value === this.open.value ? this.ended.value : null));
    this.result = computed(() => this.results.value.get(this.shown.value ?? '') ?? null);
    effect(() => {
      if (store.active.value && !store.replaying.value) this.seenActive = store.sessionId.value;
      const ended = this.ended.value;
      if (ended === null || ended !== this.seenActive) return;
      this.seenActive = null;
      this.open.value = ended;
    });
    effect(() => {
      if (this.shown.value !== null) void this.ask(this.shown.value);
    });
  }

  show(): void {
    this.open.value = this.ended.peek();
  }

  close(): void {
    this.open.value = null;
  }

  /** Once a session: what ended is judged once. What could not be had is asked for again when it is shown again. */
  private async ask(id: string): Promise<void> {
    if (this.asking.has(id) || this.results.peek().get(id)?.kind === 'score') return;
    this.asking.add(id);
    const result = await this.answer(id, asksMost);
    this.asking.delete(id);
    if (result === null) this.withheld.value = new Set([...this.withheld.peek(), id]);
    else this.results.value = new Map([...this.results.peek(), [id, result]]);
  }

  /** Null: it is not for who uses the page. */
  private async answer(id: string, asks: number): Promise<Result | null> {
    try {
      return { kind: 'score', score: await this.sources.score(id) };
    } catch (error) {
      if (error instanceof ApiError && refusals.includes(error.status)) return null;
      if (asks <= 1) return { kind: 'failed', reason: messageOf(error) };
      await new Promise((resolve) => setTimeout(resolve, askAgainMs));
      return this.answer(id, asks - 1);
    }
  }
}
