import { computed, effect, type ReadonlySignal, signal } from '@preact/signals';

import { ApiError } from '../../wire/rest';
import type { Session, Study } from '../../wire/rest_types';
import type { Permissions } from '../permissions';
import type { PracticeStore } from '../practice_store';
import type { Route } from '../route';
import type { Store } from '../store';

interface Sources {
  store: Store;
  practice: PracticeStore;
  route: ReadonlySignal<Route>;
  may: () => Pick<Permissions, 'takePart' | 'teach'>;
  study: (id: string) => Promise<Pick<Study, 'feel'>>;
}

/**
 * Whether the session that is watched is one of a blind study of feel and done here. Then its bone, forces and results
 * must not be seen outside of theatre: they would tell what the plates are made of.
 */
export class FeelWatch {
  /** The session while theatre does not hide it; null: there is nothing to hide. */
  readonly hidden: ReadonlySignal<Session | null>;
  /** Whether the studies of sessions in theatre are of feel, as far as that is known. */
  private readonly ofFeel = signal<ReadonlyMap<string, boolean>>(new Map());
  private readonly asking = new Set<string>();

  constructor(private readonly sources: Sources) {
    const { store } = sources;
    const watched = computed(() => {
      const session = store.watched.value;
      return session?.theatre === true && session.study !== null && !store.replaying.value ? session : null;
    });
    this.hidden = computed(() => {
      const session = watched.value;
      if (session === null || !this.isHere(session)) return null;
      const begun = store.sessionState.value !== 'created' && store.sessionState.value !== null;
      return begun && this.ofFeel.value.get(session.study ?? '') !== false ? session : null;
    });
    effect(() => void this.ask(watched.value?.study ?? null));
  }

  /** Participants see no sessions but their own; staff sees all, and may run one of them on this page. */
  private isHere(session: Session): boolean {
    const { practice, route, may } = this.sources;
    const { takePart, teach } = may();
    return takePart && (!teach || route.value.kind === 'trainee' || practice.lastSessionId.value === session.id);
  }

  private async ask(id: string | null): Promise<void> {
    if (id === null || this.ofFeel.peek().has(id) || this.asking.has(id)) return;
    this.asking.add(id);
    // Who may not know of the study does not take part in it. Without an answer it is asked for again.
    const feel = await this.sources.study(id).then(
      (study) => Boolean(study.feel),
      (error: unknown) => (error instanceof ApiError && error.status !== 0 ? false : null),
    );
    this.asking.delete(id);
    if (feel !== null) this.ofFeel.value = new Map([...this.ofFeel.peek(), [id, feel]]);
  }
}
