import { batch, signal } from '@preact/signals';

import { ApiError, type Api } from '../../wire/api';
import { Link, type LinkState } from '../../wire/link';
import type { BlockSurface, Hello, MeshDelta, StreamMessage, Telemetry, ToolMesh } from '../../wire/messages';
import { messageOf } from '../../wire/rest';
import type { StreamSocket } from '../../wire/stream_socket';
import type { Player } from '../player';
import { Scrubber } from '../scrubber';
import type { Store } from '../store';
import type { PlaybackChange, Replay } from '../../wire/rest_types';
import { unreadableFile } from './session_error';

/** Where pictures go. */
export interface Picture {
  begin(hello: Hello): void;
  apply(mesh: MeshDelta): void;
  /** Surfaces of fewer triangles for blocks that are shown. */
  simplify(blocks: readonly BlockSurface[]): void;
  setTool(tool: ToolMesh): void;
}

/**
 * Shows one recording by a replay of its own: opens it, follows its stream into the store and the picture, and where the
 * replay is gone (it was left alone too long, or the server has begun anew) opens another at the same moment.
 */
export class ReplayPlayer implements Player {
  readonly scrubber: Scrubber;
  /** Why the recording cannot be shown, as the server refuses it; trying again does not help. */
  readonly refused = signal<ApiError | null>(null);
  private readonly link: Link;
  private replayId: string | null = null;
  /** Where it stood last, s; there another replay goes on. */
  private leftAtS = 0;

  constructor(
    private readonly sessionId: string,
    private readonly store: Store,
    private readonly api: Pick<Api, 'openReplay' | 'replay' | 'changePlayback' | 'streamUrl'>,
    socket: StreamSocket,
    private readonly picture: Picture,
  ) {
    this.link = new Link({
      socket,
      findStream: () => this.findStream(),
      onState: (state) => this.onLink(state),
      onMessage: (message) => this.onMessage(message),
    });
    this.scrubber = new Scrubber(
      (positionS) => this.change({ position_s: positionS }),
      (error) => this.showError(error),
    );
  }

  private onLink(state: LinkState): void {
    batch(() => {
      if (state.kind === 'lost') {
        this.store.pictureComplete.value = false;
        this.store.metWithLoss.value = true;
      }
      this.store.link.value = state;
    });
  }

  start(): void {
    this.refused.value = null;
    this.link.connect();
  }
  stop(): void {
    this.link.stop();
    this.store.pictureComplete.value = false;
  }

  get durationS(): number {
    return (this.store.hello.peek()?.durationTicks ?? 0) / 1000;
  }

  async play(change: PlaybackChange): Promise<void> {
    await this.change(change).catch((error: unknown) => this.showError(error));
  }

  private async change(change: PlaybackChange): Promise<void> {
    const id = this.replayId;
    if (id === null) return;
    if (change.position_s !== undefined) this.leftAtS = change.position_s;
    this.update(await this.api.changePlayback(id, change));
  }

  /** Null where there is nothing to stream, and nothing is tried again. */
  private async findStream(): Promise<string | null> {
    const open = await this.openAgain();
    if (open !== null) return this.api.streamUrl(open);
    try {
      const replay = await this.api.openReplay(this.sessionId);
      this.replayId = replay.id;
      this.update(replay);
      if (this.leftAtS > 0) this.update(await this.api.changePlayback(replay.id, { position_s: this.leftAtS }));
      return this.api.streamUrl(replay.id);
    } catch (error) {
      if (!isRefusal(error)) throw error;
      this.refused.value = error;
      this.link.stop();
      return null;
    }
  }

  /** The replay that was open, where it still is. */
  private async openAgain(): Promise<string | null> {
    const id = this.replayId;
    if (id === null) return null;
    try {
      this.update(await this.api.replay(id));
      return id;
    } catch (error) {
      if (!(error instanceof ApiError) || error.status !== 404) throw error;
      this.replayId = null;
      return null;
    }
  }

  /** Damage may be found, and marks be made, while it is open. */
  private update(replay: Replay): void {
    batch(() => {
      this.store.replayId.value = replay.id;
      this.store.sessionId.value = replay.id;
      this.store.sessionState.value = 'replaying';
      this.store.marks.value = replay.marks;
      this.store.recordingWarning.value = replay.warning;
    });
  }

  private onMessage(message: StreamMessage): void {
    if (message.kind === 'simpler') return this.picture.simplify(message.blocks);
    const { store } = this;
    batch(() => {
      store.lastMessageMs.value = Date.now();
      switch (message.kind) {
        case 'hello':
          store.hello.value = message.hello;
          store.telemetry.value = null;
          store.pictureComplete.value = false;
          return this.picture.begin(message.hello);
        case 'mesh':
          this.picture.apply(message.mesh);
          if (message.mesh.blocks.length > 0) store.hasPicture.value = true;
          if (message.mesh.keyComplete) store.pictureComplete.value = true;
          return;
        case 'telemetry':
          return this.onTelemetry(message.telemetry);
        case 'tool':
          return this.picture.setTool(message.tool);
      }
    });
    if (store.telemetry.peek()?.state === 'stopped') return this.start(); // that replay has ended
    this.link.expectTraffic(store.telemetry.peek() !== null);
  }

  private onTelemetry(telemetry: Telemetry): void {
    const { store } = this;
    store.telemetry.value = telemetry;
    store.playback.value = telemetry.playback;
    if (telemetry.playback === null) return;
    this.leftAtS = telemetry.playback.positionTicks / 1000;
    this.scrubber.onStreamUpdate();
  }

  private showError(error: unknown): void {
    this.store.problem.value = messageOf(error);
  }
}

/** The session is gone, goes on, was never recorded, is damaged, or is not for this user. */
const isRefusal = (error: unknown): error is ApiError =>
  error instanceof ApiError && [403, 404, 409, unreadableFile, 422].includes(error.status);
