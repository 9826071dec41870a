import { computed, effect, type ReadonlySignal, signal } from '@preact/signals';

import type { Session, Study } from '../../wire/rest_types';
import type { Store } from '../store';

interface Sources {
  store: Store;
  study: (id: string) => Promise<Pick<Study, 'name'>>;
  /** How many sessions the participant had in the study before this one; null for who may not list all of them. */
  earlier: (session: InStudy) => Promise<number | null>;
}

/** A session of a study, as far as this matters. */
export type InStudy = Pick<Session, 'id' | 'created_utc'> & { study: string; participant: string };

/** That the watched session is one of a study; what is not known (yet) is null. */
export interface StudyOfSession {
  session: string;
  name: string | null;
  participant: string;
  /** 1 for the participant's first session in the study. */
  attempt: number | null;
}

/** Of which study the watched session is, for who takes part and for who watches. */
export class StudyLine {
  readonly now: ReadonlySignal<StudyOfSession | null>;
  private readonly known = signal<StudyOfSession | null>(null);

  constructor(private readonly sources: Sources) {
    const { store } = sources;
    const watched = computed(() => (store.replaying.value ? null : inStudy(store.watched.value)));
    const id = computed(() => watched.value?.id ?? null);
    this.now = computed(() => {
      const session = watched.value;
      if (session === null) return null;
      const known = this.known.value;
      if (known?.session === session.id) return known;
      return { session: session.id, name: null, participant: session.participant, attempt: null };
    });
    effect(() => {
      if (id.value === null) return;
      const session = watched.peek();
      if (session !== null) void this.read(session);
    });
  }

  /** Once for a session. What cannot be read is left out: somebody may watch without knowing of the study. */
  private async read(session: InStudy): Promise<void> {
    const [name, earlier] = await Promise.all([
      this.sources.study(session.study).then(
        (study) => study.name,
        () => null,
      ),
      this.sources.earlier(session).catch(() => null),
    ]);
    if (this.now.peek()?.session !== session.id) return;
    const attempt = earlier === null ? null : earlier + 1;
    this.known.value = { session: session.id, name, participant: session.participant, attempt };
  }
}

function inStudy(session: Session | null): InStudy | null {
  if (session === null || session.study === null || session.participant === null) return null;
  const { id, created_utc, study, participant } = session;
  return { id, created_utc, study, participant };
}
