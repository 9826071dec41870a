import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { ReplayPlayer } from '../../../src/state/review/replay_player';
import { Store } from '../../../src/state/store';
import { ApiError } from '../../../src/wire/api';
import { hello, telemetry, wholePicture } from '../../wire/fake_messages';
import { FakeSocket } from '../../wire/fake_socket';
import type { PlaybackChange, Replay } from '../../../src/wire/rest_types';
import { someReplay } from '../../wire/some_answers';

/** A server that keeps replays until the test ends them. */
class FakeReplays {
  open = new Map<string, Replay>();
  changes: PlaybackChange[] = [];
  refuse: ApiError | null = null;
  private made = 0;

  openReplay = (sessionId: string): Promise<Replay> => {
    if (this.refuse !== null) return Promise.reject(this.refuse);
    const marks = [{ at_s: 2, kind: 'annotation', words: 'here' }];
    const replay = someReplay({ id: `r${++this.made}`, replay_of: sessionId, marks });
    this.open.set(replay.id, replay);
    return Promise.resolve(replay);
  };
  replay = (id: string): Promise<Replay> => {
    const found = this.open.get(id);
    return found === undefined ? Promise.reject(new ApiError(`no session '${id}'`, 404)) : Promise.resolve(found);
  };
  changePlayback = (id: string, change: PlaybackChange): Promise<Replay> => {
    this.changes.push(change);
    return this.replay(id);
  };
  streamUrl = (id: string) => `ws://here/${id}`;
}

const settle = () => vi.advanceTimersByTimeAsync(0);
const at = (positionTicks: number) =>
  telemetry({ state: 'replaying', playback: { positionTicks, speed: 1, playing: false, jump: 1 } });

function begin() {
  const store = new Store();
  const api = new FakeReplays();
  const socket = new FakeSocket();
  const begun: string[] = [];
  const picture = {
    begin: () => begun.push('begin'),
    apply: () => undefined,
    simplify: () => begun.push('simplify'),
    setTool: () => undefined,
  };
  const player = new ReplayPlayer('abcd', store, api, socket, picture);
  player.start();
  return { store, api, socket, player, begun };
}

describe('player of a recording', () => {
  beforeEach(() => void vi.useFakeTimers());
  afterEach(() => void vi.useRealTimers());

  it('opens a replay and tells the store where it stands', async () => {
    const { store, socket, begun } = begin();
    await settle();
    expect(socket.opened).toEqual(['ws://here/r1']);
    expect(store.marks.value).toHaveLength(1);
    socket.handlers?.onMessage(hello({ replayOf: 'abcd', durationTicks: 10_000 }));
    socket.handlers?.onMessage(wholePicture);
    socket.handlers?.onMessage(at(1500));
    expect(begun).toEqual(['begin']);
    expect(store.upToDate.value).toBe(true);
    expect(store.live.value).toBe(false);
    expect(store.playback.value?.positionTicks).toBe(1500);
    const newsMs = store.lastMessageMs.value;
    await vi.advanceTimersByTimeAsync(500);
    socket.handlers?.onMessage({ kind: 'simpler', blocks: [] });
    expect(begun).toEqual(['begin', 'simplify']);
    expect(store.lastMessageMs.value).toBe(newsMs);
  });

  it('says that what is shown is of before when the stream is lost, and finds the same replay again', async () => {
    const { store, socket } = begin();
    await settle();
    socket.handlers?.onMessage(hello({ replayOf: 'abcd', durationTicks: 10_000 }));
    socket.handlers?.onMessage(wholePicture);
    socket.end('cut');
    expect(store.upToDate.value).toBe(false);
    expect(store.link.value.kind).toBe('lost');
    await vi.advanceTimersByTimeAsync(5000);
    expect(socket.opened).toEqual(['ws://here/r1', 'ws://here/r1']);
  });

  it('opens another where the replay has ended, at the same moment', async () => {
    const { api, socket } = begin();
    await settle();
    socket.handlers?.onMessage(hello({ replayOf: 'abcd', durationTicks: 10_000 }));
    socket.handlers?.onMessage(at(4200));
    api.open.clear();
    socket.end('gone');
    await vi.advanceTimersByTimeAsync(5000);
    expect(socket.opened.at(-1)).toBe('ws://here/r2');
    expect(api.changes).toEqual([{ position_s: 4.2 }]);
  });

  it('gives up where the server refuses, with its reason, until it is asked again', async () => {
    for (const status of [403, 404, 409, 422]) {
      const { api, socket, player } = { ...begin() };
      api.refuse = new ApiError('because', status);
      player.start();
      await settle();
      expect(player.refused.value?.status).toBe(status);
      const tries = socket.opened.length;
      await vi.advanceTimersByTimeAsync(60_000);
      expect(socket.opened).toHaveLength(tries);
      api.refuse = null;
      player.start();
      await settle();
      expect(player.refused.value).toBeNull();
      expect(socket.opened.length).toBeGreaterThan(tries);
    }
  });

  it('goes on trying where the server does not answer', async () => {
    const { api, socket, player, store } = begin();
    api.refuse = new ApiError('no answer', 0);
    player.start();
    await settle();
    expect(store.link.value.kind).toBe('lost');
    expect(player.refused.value).toBeNull();
    api.refuse = null;
    await vi.advanceTimersByTimeAsync(20_000);
    expect(socket.opened.length).toBeGreaterThan(0);
  });

  it('opens another when the server ends the replay that is watched', async () => {
    const { api, socket } = begin();
    await settle();
    socket.handlers?.onMessage(hello({ replayOf: 'abcd', durationTicks: 10_000 }));
    socket.handlers?.onMessage(at(700));
    api.open.clear();
    socket.handlers?.onMessage(
      telemetry({ state: 'stopped', playback: { positionTicks: 700, speed: 1, playing: false, jump: 1 } }),
    );
    await settle();
    expect(socket.opened.at(-1)).toBe('ws://here/r2');
    expect(api.changes.at(-1)).toEqual({ position_s: 0.7 });
  });
});
