import { batch } from '@preact/signals';

import { ApiError, type Api } from '../wire/api';
import { appText } from '../text/app_text';
import { chooseSession, type Watched } from './choose_session';
import type { Store } from './store';
import type { Replay, Session } from '../wire/rest_types';

/** What the watcher may do, as of now. */
export interface WatcherPolicy {
  /** Make a session that waits to be started where there is none, so that there is bone to see. */
  makesSession(): boolean;
}

/** Finds what is to be watched: the replay that is wanted, else the chosen session, else one that is under way. */
export class StreamFinder {
  private readonly unstreamable = new Set<string>();
  /** A stream was asked for and has not said hello. */
  private awaitingHello = false;
  private endedWithoutHello = 0;

  constructor(
    private readonly store: Store,
    private readonly api: Api,
    private readonly policy: WatcherPolicy,
  ) {}

  /** The address of its stream; null where there is nothing to watch. */
  async find(): Promise<string | null> {
    this.awaitingHello = false;
    const replayId = this.store.replayId.value;
    if (replayId !== null) {
      const stream = await this.findReplay(replayId);
      if (stream !== null) return stream;
    }
    const listed = await this.api.sessions();
    this.store.sessions.value = listed;
    const session =
      this.choose(await this.withWatched(listed)) ??
      (this.policy.makesSession() ? await this.api.createDemo() : undefined);
    if (session === undefined) return this.findNothing();
    batch(() => {
      if (session.id !== this.store.sessionId.value) this.endedWithoutHello = 0;
      this.store.sessionId.value = session.id;
      this.store.sessionState.value = session.state;
    });
    this.awaitingHello = true;
    return this.api.streamUrl(session.id);
  }

  /** Throws while the server only prepares for sessions. */
  private async findNothing(): Promise<null> {
    await this.api.ready();
    this.store.sessionId.value = null;
    this.store.sessionState.value = null;
    return null;
  }

  choose(sessions: readonly Session[]): Session | undefined {
    return chooseSession(sessions, this.watched(), this.unstreamable);
  }

  /** The stream that was found has said hello. */
  greeted(): void {
    this.awaitingHello = false;
    this.endedWithoutHello = 0;
  }

  /** A session that is listed but twice gave no stream is left aside. */
  countSilentEnd(): void {
    const id = this.store.sessionId.value;
    if (!this.awaitingHello || id === null) return;
    if (++this.endedWithoutHello >= 2 && !this.store.active.value) this.unstreamable.add(id);
  }

  /** One that nobody had started is no loss. */
  forgetDeleted(id: string): void {
    const missed = this.store.sessionState.value !== 'created' && this.store.sessionState.value !== null;
    batch(() => {
      if (missed) this.store.problem.value = appText.sessionGone(id);
      if (this.store.chosenId.value === id) this.store.chosenId.value = null;
      this.store.sessionId.value = null;
      this.store.sessionState.value = null;
    });
  }

  forgetReplay(): void {
    batch(() => {
      this.store.replayId.value = null;
      this.store.sessionId.value = this.store.chosenId.value;
      this.store.playback.value = null;
      this.store.marks.value = [];
      this.store.recordingWarning.value = null;
    });
  }

  /** Damage may be found, and marks be made, while the replay is open. */
  update(replay: Replay): void {
    batch(() => {
      this.store.marks.value = replay.marks;
      this.store.recordingWarning.value = replay.warning;
    });
  }

  private watched(): Watched {
    const chosenId = this.store.chosenId.value;
    return { id: chosenId ?? this.store.sessionId.value, chosen: chosenId !== null };
  }

  /** The list has the newest sessions only; the watched one may be older. If it has been deleted, this says so. */
  private async withWatched(sessions: readonly Session[]): Promise<readonly Session[]> {
    const { id } = this.watched();
    if (id === null || sessions.some((session) => session.id === id)) return sessions;
    try {
      return [...sessions, await this.api.session(id)];
    } catch (error) {
      if (!(error instanceof ApiError) || error.status !== 404) throw error;
      this.forgetDeleted(id);
      return sessions;
    }
  }

  /** Null when the replay is gone; then what is live is to be watched. */
  private async findReplay(replayId: string): Promise<string | null> {
    try {
      const replay = await this.api.replay(replayId);
      batch(() => {
        this.store.sessionId.value = replay.id;
        this.store.sessionState.value = 'replaying';
        this.update(replay);
      });
      return this.api.streamUrl(replay.id);
    } catch (error) {
      if (!(error instanceof ApiError) || error.status !== 404) throw error;
      this.forgetReplay();
      this.store.problem.value = appText.replayGone;
      return null;
    }
  }
}
