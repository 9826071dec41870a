import { batch } from '@preact/signals';

import { ApiError, type Api } from '../wire/api';
import { Link, type LinkState } from '../wire/link';
import type { BlockSurface, Hello, MeshDelta, StreamMessage, Telemetry, ToolMesh } from '../wire/messages';
import type { StreamSocket } from '../wire/stream_socket';
import { appText } from '../text/app_text';
import { messageOf, noAnswer } from '../wire/rest';
import { isActive } from './choose_session';
import { Lateness } from './lateness';
import { Scrubber } from './scrubber';
import type { Store } from './store';
import { StreamFinder, type WatcherPolicy } from './stream_finder';
import type { PlaybackChange, Session } from '../wire/rest_types';

/** Where pictures go. */
export interface Picture {
  begin(hello: Hello): void;
  apply(mesh: MeshDelta): void;
  /** Surfaces of fewer triangles for blocks that are shown. */
  simplify(blocks: readonly BlockSurface[]): void;
  setTool(tool: ToolMesh): void;
}

const idlePollMs = 2500;
/** A session that rests sends nothing, so that a cut connection is only noticed by questions that are not answered. */
const answerWithinMs = 8000;

/**
 * Watches one session at a time: finds it, follows its stream into the store and the picture, and finds another when
 * it is gone or a newer one runs. Watches a replay instead while one is wanted. Carries out what the user asks for.
 */
export class Watcher {
  private readonly link: Link;
  /** Goes to moments of the watched replay. */
  readonly scrubber: Scrubber;
  private readonly finder: StreamFinder;
  private lateness = new Lateness();
  private pollTimer: ReturnType<typeof setInterval> | undefined;

  constructor(
    private readonly store: Store,
    private readonly api: Api,
    socket: StreamSocket,
    private readonly picture: Picture,
    policy: WatcherPolicy = { makesSession: () => true },
  ) {
    this.finder = new StreamFinder(store, api, policy);
    this.link = new Link({
      socket,
      findStream: () => this.finder.find(),
      onState: (state) => this.onLink(state),
      onMessage: (message) => this.onMessage(message),
    });
    this.scrubber = new Scrubber(
      (positionS) => this.changeReplay({ position_s: positionS }),
      (error) => this.showError(error),
    );
  }

  /** Begins to watch, unless it does already. */
  start(): void {
    if (this.pollTimer !== undefined) return;
    this.link.connect();
    void this.readSessions();
    this.pollTimer = setInterval(() => void this.lookForNewer(), idlePollMs);
  }

  /** Watches nothing any more, and nothing that was seen counts as live. */
  rest(): void {
    if (this.pollTimer === undefined) return;
    clearInterval(this.pollTimer);
    this.pollTimer = undefined;
    this.link.stop();
    this.store.pictureComplete.value = false;
  }

  /** Watches this session, and no newer one that is started elsewhere, for as long as it can be watched. */
  watch(sessionId: string): void {
    batch(() => {
      if (this.store.replayId.value !== null) this.finder.forgetReplay();
      this.store.chosenId.value = sessionId;
      this.store.sessionId.value = sessionId;
    });
    this.turn();
  }

  /** Starts the watched session if it waits to be started, else a new one; problems go to the store. */
  async runDemo(): Promise<void> {
    await this.carryOut(async () => {
      const waiting = this.store.sessionState.value === 'created' ? this.store.sessionId.value : null;
      const session = (waiting === null ? null : await this.startWaiting(waiting)) ?? (await this.startNew());
      this.store.sessionState.value = session.state;
      this.store.chosenId.value = null;
      if (session.id !== this.store.hello.value?.sessionId || this.store.link.value.kind !== 'live') {
        this.store.sessionId.value = session.id;
        this.turn();
      }
    });
  }

  /** Makes and starts a session that a hand in the browser steers, and watches it; its id, or null when that failed. */
  practise(caseId = 'demo', theatre = false): Promise<string | null> {
    return this.begin(() => this.api.createPractice(caseId, theatre));
  }

  /** Makes and starts a session of a study, and watches it; null when that failed. `participant` null: the user. */
  async train(studyId: string, participant: string | null, caseId: string): Promise<Session | null> {
    let made: Session | null = null;
    const id = await this.begin(async () => (made = await this.api.createInStudy(studyId, participant, caseId)));
    return id === null ? null : made;
  }

  /** Makes and starts another session of the same kind as one that has ended, on intact bone, and watches it. */
  repeat(sessionId: string): Promise<string | null> {
    return this.begin(() => this.api.reset(sessionId));
  }

  private async begin(make: () => Promise<Session>): Promise<string | null> {
    let id: string | null = null;
    await this.carryOut(async () => {
      const session = await this.api.start((await make()).id);
      id = session.id;
      batch(() => {
        this.store.chosenId.value = null;
        this.store.sessionId.value = session.id;
        this.store.sessionState.value = session.state;
        this.store.details.value = session;
      });
      this.turn();
    });
    return id;
  }

  /** Pauses the watched session, or lets it go on. */
  async pause(paused: boolean): Promise<void> {
    await this.carryOut(async () => {
      const id = this.store.sessionId.value;
      if (id === null) return;
      const session = await (paused ? this.api.pause(id) : this.api.start(id));
      if (id !== this.store.sessionId.value) return;
      this.store.sessionState.value = session.state;
      this.store.details.value = session;
    });
  }

  /** Begins the watched session anew on intact bone, as another session; its id, or null when that failed. */
  async reset(): Promise<string | null> {
    let id: string | null = null;
    await this.carryOut(async () => {
      const before = this.store.sessionId.value;
      if (before === null) return;
      const session = await this.api.reset(before);
      id = session.id;
      batch(() => {
        this.store.sessionId.value = session.id;
        this.store.sessionState.value = session.state;
        this.store.details.value = session;
        if (this.store.chosenId.value !== null) this.store.chosenId.value = session.id;
      });
      this.turn();
    });
    return id;
  }

  /** Ends the watched session. */
  async stop(): Promise<void> {
    await this.carryOut(async () => {
      const id = this.store.sessionId.value;
      if (id === null) return;
      this.store.sessionState.value = (await this.api.stop(id)).state;
      // The stream, where it says so later, tells nothing new then.
      void this.readMetrics();
    });
  }

  /** Opens the recording of a session and watches it. */
  async openReplay(sessionId: string): Promise<void> {
    await this.carryOut(async () => this.watchReplay((await this.api.openReplay(sessionId)).id));
  }

  /** Watches a replay that is open, perhaps by somebody else's hand. */
  watchReplay(replayId: string): void {
    if (replayId === this.store.replayId.value) return;
    this.store.replayId.value = replayId;
    this.turn();
  }

  /** Back to what is live. The replay stays open for others. */
  leaveReplay(): void {
    if (this.store.replayId.value === null) return;
    this.finder.forgetReplay();
    this.turn();
  }

  /** Plays, rests or changes the speed of the watched replay. */
  async play(change: PlaybackChange): Promise<void> {
    await this.changeReplay(change).catch((error: unknown) => this.showError(error));
  }

  private async changeReplay(change: PlaybackChange): Promise<void> {
    const id = this.store.replayId.value;
    if (id === null) return;
    const replay = await this.api.changePlayback(id, change);
    if (id === this.store.replayId.value) this.finder.update(replay);
  }

  private async startNew() {
    return this.api.start((await this.api.createDemo()).id);
  }

  /** Null when the session is gone or was started by somebody else. */
  private async startWaiting(id: string) {
    try {
      return await this.api.start(id);
    } catch (error) {
      if (error instanceof ApiError && (error.status === 404 || error.status === 409)) return null;
      throw error;
    }
  }

  private async carryOut(action: () => Promise<void>): Promise<void> {
    this.store.busy.value = true;
    this.store.problem.value = null;
    try {
      await action();
    } catch (error) {
      this.showError(error);
    } finally {
      this.store.busy.value = false;
    }
  }

  private showError(error: unknown): void {
    this.store.problem.value = messageOf(error);
  }

  /** Leaves what is shown for what is to be watched now; until that has come, what is shown is of before. */
  private turn(): void {
    this.store.pictureComplete.value = false;
    this.link.connect();
  }

  private onLink(state: LinkState): void {
    batch(() => {
      if (state.kind === 'lost') {
        this.store.pictureComplete.value = false;
        this.store.metWithLoss.value = true;
      }
      this.store.link.value = state;
    });
    if (state.kind === 'lost' && state.retryAtMs !== null) this.finder.countSilentEnd();
  }

  private onMessage(message: StreamMessage): void {
    if (message.kind === 'simpler') return this.picture.simplify(message.blocks);
    batch(() => {
      this.store.lastMessageMs.value = Date.now();
      switch (message.kind) {
        case 'hello':
          return this.onHello(message.hello);
        case 'mesh':
          this.picture.apply(message.mesh);
          if (message.mesh.blocks.length > 0) this.store.hasPicture.value = true;
          if (message.mesh.keyComplete) this.store.pictureComplete.value = true;
          return;
        case 'telemetry':
          return this.onTelemetry(message.telemetry);
        case 'tool':
          return this.picture.setTool(message.tool);
      }
    });
    const state = this.store.sessionState.value;
    if (state === 'stopped' && this.store.playback.value !== null && this.store.replayId.value !== null) {
      this.leaveReplay();
      this.store.problem.value = appText.replayGone;
      return;
    }
    this.link.expectTraffic(this.sendsAllTheTime());
  }

  /** Whether silence of the stream means trouble. */
  private sendsAllTheTime(): boolean {
    const state = this.store.sessionState.value;
    return this.store.telemetry.value !== null && (state === 'running' || state === 'replaying');
  }

  private onHello(hello: Hello): void {
    this.finder.greeted();
    this.store.behindMs.value = 0;
    const before = this.store.hello.value;
    if (before?.serverEpoch !== hello.serverEpoch) this.lateness = new Lateness();
    const sameSession = before?.sessionId === hello.sessionId && before.serverEpoch === hello.serverEpoch;
    if (!sameSession) {
      this.store.trace.clear();
      ++this.store.traceRevision.value;
      this.store.telemetry.value = null;
      this.store.playback.value = null;
      this.store.metrics.value = null;
    }
    this.store.hello.value = hello;
    this.store.pictureComplete.value = false;
    this.picture.begin(hello);
    void this.readMetrics();
  }

  private onTelemetry(telemetry: Telemetry): void {
    if (telemetry.playback?.jump !== this.store.playback.value?.jump) {
      this.store.trace.clear();
      ++this.store.traceRevision.value;
    }
    if (telemetry.thrustN.length > 0) {
      this.store.trace.append(telemetry.firstTick, telemetry.tickStride, {
        thrustN: telemetry.thrustN,
        feedRateMmS: telemetry.feedRatesMmS,
        vibrationG: telemetry.vibrationG,
      });
      ++this.store.traceRevision.value;
    }
    this.store.behindMs.value = this.behind(telemetry);
    const ended = this.store.sessionState.value !== telemetry.state;
    this.store.telemetry.value = telemetry;
    this.store.playback.value = telemetry.playback;
    if (telemetry.playback !== null) this.scrubber.onStreamUpdate();
    this.store.sessionState.value = telemetry.state;
    if (ended) void this.readMetrics();
  }

  /** The last telemetry of a paused session is its newest, however late it came. */
  private behind({ stampMs, receivedMs, state }: Telemetry): number {
    if (stampMs === 0 || receivedMs === undefined) return 0;
    const behindMs = this.lateness.of(stampMs, receivedMs);
    return state === 'running' || state === 'replaying' ? behindMs : 0;
  }

  /** Final figures, once a session has ended. They are a supplement: without them the page shows the rest. */
  private async readMetrics(): Promise<void> {
    const id = this.store.sessionId.value;
    const state = this.store.sessionState.value;
    if (id === null || this.store.replaying.value || !(state === 'finished' || state === 'stopped')) {
      this.store.metrics.value = null;
      return;
    }
    const metrics = await this.api.metrics(id).catch(() => null);
    if (id === this.store.sessionId.value) this.store.metrics.value = metrics;
  }

  /** Health of the watched session; without it the page shows the rest. */
  private async readDetails(): Promise<void> {
    const id = this.store.sessionId.value;
    if (id === null || this.store.replaying.value) {
      this.store.details.value = null;
      return;
    }
    let gone = false;
    const details = await this.api.session(id).catch((error: unknown) => {
      gone = error instanceof ApiError && error.status === 404;
      return null;
    });
    if (id !== this.store.sessionId.value) return;
    this.store.details.value = details;
    if (!gone) return;
    this.finder.forgetDeleted(id);
    this.turn();
  }

  private async readSessions(): Promise<readonly Session[]> {
    const requestedMs = Date.now();
    try {
      const sessions = await Promise.race([this.api.sessions(), noAnswerAfter(answerWithinMs)]);
      batch(() => {
        this.store.sessions.value = sessions;
        this.store.sessionsKnown.value = true;
      });
      return sessions;
    } catch (error) {
      const silent = !this.sendsAllTheTime() && (this.store.lastMessageMs.value ?? 0) <= requestedMs;
      if (silent && error instanceof ApiError && error.status === 0) this.link.giveUp(error.message);
      return [];
    }
  }

  /** While the watched session rests, another may have been started elsewhere, or this one. */
  private async lookForNewer(): Promise<void> {
    if (this.store.link.value.kind !== 'live' || this.store.busy.value) return;
    void this.readDetails();
    const sessions = await this.readSessions();
    if (this.store.active.value || this.store.replaying.value || this.store.busy.value) return;
    const chosen = this.finder.choose(sessions);
    if (chosen !== undefined && isActive(chosen) && chosen.id !== this.store.sessionId.value) this.turn();
  }
}

const noAnswerAfter = (ms: number) =>
  new Promise<never>((_, reject) => setTimeout(() => reject(new ApiError(noAnswer, 0)), ms));
