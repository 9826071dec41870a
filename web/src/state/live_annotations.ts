import { computed, effect, signal } from '@preact/signals';

import type { ChangeHandlers, ChangeSocket } from '../wire/change_socket';
import type { ReviewApi } from '../wire/review_api';
import { Remote } from './remote';
import type { Store } from './store';
import type { Annotation } from '../wire/rest_types';

/** Others may annotate the same session. */
const readAgainMs = 5000;

/** Annotations of the watched session, by whoever watches. A replay's are on its review. */
export class LiveAnnotations {
  /** The moment that an annotation being written is about: when writing began, s. Null: nothing is written. */
  readonly momentS = signal<number | null>(null);
  /** As the server last said them, the oldest first. */
  readonly read: Remote<{ session: string; annotations: Annotation[] }>;

  /** The watched session's, the newest first. */
  readonly annotations = computed((): readonly Annotation[] => {
    const known = this.read.value.value;
    return known === null || known.session !== this.store.sessionId.value ? [] : [...known.annotations].reverse();
  });

  /** Made on this page. */
  private readonly own = new Set<string>();

  constructor(
    private readonly store: Store,
    private readonly api: Pick<ReviewApi, 'annotations' | 'annotate'>,
    private readonly socketFor: (handlers: ChangeHandlers) => Pick<ChangeSocket, 'start' | 'stop'> = () => silent,
  ) {
    this.read = new Remote(async () => {
      const session = store.sessionId.peek() ?? '';
      return { session, annotations: await api.annotations(session) };
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

  /** Hears of each annotation as it is made, until the result is called. */
  hearAtOnce(): () => void {
    const socket = this.socketFor({
      onChange: ({ kind, id, change }) => {
        const session = this.store.sessionId.peek();
        const annotated = kind === 'session' && change === 'annotated' && id === session;
        if (annotated || kind === 'hello' || kind === 'missed') this.readNow();
      },
      onLost: () => undefined,
    });
    socket.start();
    const stop = this.follow();
    return () => {
      socket.stop();
      stop();
    };
  }

  private readNow(): void {
    const { store } = this;
    if (store.sessionId.peek() !== null && !store.replaying.peek() && begun(store)) void this.read.read();
  }

  isOwn(annotation: Annotation): boolean {
    return this.own.has(keyOf(annotation));
  }

  /** Somebody begins to write: what is written is about this moment. */
  begin(): void {
    this.momentS.value ??= (this.store.telemetry.peek()?.tick ?? 0) / 1000;
  }
  forget(): void {
    this.momentS.value = null;
  }

  /** Whether the annotation is kept. */
  async keep(text: string): Promise<boolean> {
    const session = this.store.sessionId.peek();
    if (session === null || text === '') return false;
    this.begin();
    const kept = await this.read.act(async () => {
      const made = await this.api.annotate(session, text, this.momentS.peek() ?? 0);
      this.own.add(keyOf(made));
      return made;
    });
    if (kept === null) return false;
    this.momentS.value = null;
    return true;
  }
}

const keyOf = ({ utc, at_s, words }: Annotation): string => `${utc} ${at_s} ${words}`;

const silent = { start: () => undefined, stop: () => undefined };

/** A session that nobody has started has no recording to annotate. */
const begun = (store: Store): boolean => store.sessionState.value !== 'created' && store.sessionState.value !== null;
