import { computed, effect, signal } from '@preact/signals';

import type { Learning, Session } from '../../wire/rest_types';
import { type Change, ChangeSocket } from '../../wire/change_socket';
import type { DashboardApi, Learner } from '../../wire/dashboard_api';
import { Remote } from '../remote';
import { type KnownLearner, learnersIn } from './learners';
import { LiveBoard } from './live_board';

/** Sessions that have ended and are looked through for who has trained. */
export const endedLooked = 100;
/** Without a change event these are read again after so long, ms. */
const readEndedEveryMs = 30_000;

type Socket = Pick<ChangeSocket, 'start' | 'stop'>;

/** All that an instructor wants to know in the morning: who reams, who has reamed, and how they come on. */
export class Dashboard {
  readonly board: LiveBoard;
  readonly ended: Remote<Session[]>;
  readonly learning: Remote<Learning>;
  /** Key of the learner who was chosen; null: whoever trained last. */
  private readonly chosen = signal<string | null>(null);
  /** Trainees have their own learning only, and it needs no name. */
  private readonly own = signal(false);
  readonly learners = computed((): readonly KnownLearner[] =>
    this.own.value ? [] : learnersIn(this.ended.value.value ?? []),
  );
  readonly learner = computed(
    () => this.learners.value.find(({ key }) => key === this.chosen.value) ?? this.learners.value[0] ?? null,
  );

  private readonly socket: Socket;
  private stops: (() => void)[] = [];

  constructor(
    private readonly api: DashboardApi,
    origin: string,
    socketFor: (handlers: ConstructorParameters<typeof ChangeSocket>[1]) => Socket = (handlers) =>
      new ChangeSocket(origin, handlers),
  ) {
    this.board = new LiveBoard(api);
    this.ended = new Remote(() => api.ended(endedLooked));
    this.learning = new Remote(() => api.learning(this.learnerQuery()));
    this.socket = socketFor({
      onChange: (change) => this.take(change),
      onLost: () => this.board.loseTouch(),
    });
  }

  /** Begins to follow; `own`: what the user may know is their own learning. Until the result is called. */
  follow(own: boolean): () => void {
    this.own.value = own;
    this.board.start();
    this.socket.start();
    void this.ended.read();
    const timer = setInterval(() => void this.ended.read(), readEndedEveryMs);
    this.stops = [
      () => clearInterval(timer),
      // Read whenever it is another's, or another session of theirs has ended.
      effect(() => this.readLearning(this.learner.value?.key ?? null, this.ended.value.value)),
    ];
    return () => {
      this.stops.forEach((stop) => stop());
      this.stops = [];
      this.socket.stop();
      this.board.stop();
      this.learningOf = undefined;
    };
  }

  choose(key: string): void {
    this.chosen.value = key;
  }

  private learningOf: string | null | undefined;

  private readLearning(key: string | null, ended: readonly Session[] | null): void {
    if (ended === null || (key === null && !this.own.value)) return;
    if (this.learningOf !== key) this.learning.value.value = null;
    this.learningOf = key;
    void this.learning.read();
  }

  private learnerQuery(): Learner {
    if (this.own.peek()) return {};
    const { trainee, participant } = this.learner.peek() ?? {};
    return { trainee, participant };
  }

  private take(change: Change): void {
    if (change.kind === 'hello' || change.kind === 'missed' || change.kind === 'session') {
      void this.board.read();
      if (change.change !== 'running' && change.change !== 'paused') void this.ended.read();
    }
  }
}
