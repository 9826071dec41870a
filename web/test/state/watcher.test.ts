import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { Store } from '../../src/state/store';
import { Watcher } from '../../src/state/watcher';
import { ApiError, type Api } from '../../src/wire/api';
import { hello, telemetry, wholePicture } from '../wire/fake_messages';
import { FakeSocket } from '../wire/fake_socket';
import type { Metrics, PlaybackChange, Replay, Session } from '../../src/wire/rest_types';
import { someDevice, someReplay, someSession } from '../wire/some_answers';

/** The REST side of a server that the test can restart. */
class FakeApi {
  list: Session[] = [];
  down = false;
  prepared = true;
  private made = 0;

  private answer<T>(value: T): Promise<T> {
    return this.down ? Promise.reject(new ApiError('no answer', 0)) : Promise.resolve(value);
  }
  private change(id: string, state: Session['state']): Promise<Session> {
    const session = this.list.find((s) => s.id === id);
    if (session === undefined) return Promise.reject(new ApiError(`no session '${id}'`, 404));
    session.state = state;
    return this.answer({ ...session });
  }
  ready = () => (this.prepared ? this.answer(undefined) : Promise.reject(new ApiError('still preparing', 503)));
  sessions = () => this.answer(this.list.map((s) => ({ ...s })));
  createDemo = () => {
    const session = someSession({
      id: `s${++this.made}`,
      state: 'created',
      created_utc: `2026-01-01T00:00:0${this.made}Z`,
    });
    this.list.unshift(session);
    return this.answer({ ...session });
  };
  session = (id: string) => {
    const found = this.list.find((s) => s.id === id);
    return found === undefined ? Promise.reject(new ApiError(`no session '${id}'`, 404)) : this.answer({ ...found });
  };
  createPractice = async () => {
    const session = await this.createDemo();
    return { ...session, device: someDevice('browser') };
  };
  start = (id: string) => this.change(id, 'running');
  pause = async (id: string) => ({ ...(await this.change(id, 'paused')), held: true });
  reset = async (id: string) => {
    await this.change(id, 'stopped');
    const session = await this.createDemo();
    return this.change(session.id, 'running');
  };
  createInStudy = async (study: string, participant: string | null) => ({
    ...(await this.createDemo()),
    study,
    participant: participant ?? 'K7-F3M',
  });
  stop = (id: string) => this.change(id, 'stopped');
  metrics = () => this.answer({ axial_thrust_mean_n: 12 } as Metrics);
  replays: Replay[] = [];
  changes: PlaybackChange[] = [];
  openReplay = (sessionId: string) => {
    const marks = [{ at_s: 2, kind: 'annotation', words: 'here' }];
    const replay = someReplay({ id: `r${sessionId}`, replay_of: sessionId, marks });
    this.replays.push(replay);
    return this.answer(replay);
  };
  replay = (id: string) => {
    const found = this.replays.find((replay) => replay.id === id);
    return found === undefined ? Promise.reject(new ApiError(`no replay '${id}'`, 404)) : this.answer(found);
  };
  changePlayback = (id: string, change: PlaybackChange) => {
    this.changes.push(change);
    return this.replay(id);
  };
  streamUrl = (id: string) => `ws://${id}`;
}

const settle = () => vi.advanceTimersByTimeAsync(0);

describe('Watcher', () => {
  let api: FakeApi;
  let socket: FakeSocket;
  let store: Store;
  let watcher: Watcher;
  const begun: string[] = [];
  let simplified = 0;

  beforeEach(() => {
    vi.useFakeTimers();
    api = new FakeApi();
    socket = new FakeSocket();
    store = new Store();
    begun.length = simplified = 0;
    const picture = {
      begin: (h: { sessionId: string }) => begun.push(h.sessionId),
      apply: () => undefined,
      simplify: () => void ++simplified,
      setTool: () => undefined,
    };
    watcher = new Watcher(store, api as unknown as Api, socket, picture);
  });
  afterEach(() => vi.useRealTimers());

  const serve = (sessionId: string, serverEpoch: string) => {
    socket.handlers?.onMessage(hello({ sessionId, serverEpoch }));
    socket.handlers?.onMessage(wholePicture);
  };

  it('creates a session so that there is bone to see, and starts that very one', async () => {
    watcher.start();
    await settle();
    expect(socket.opened).toEqual(['ws://s1']);
    expect(api.list.map((s) => s.state)).toEqual(['created']);
    serve('s1', '1');
    expect(store.live.value).toBe(true);
    await watcher.runDemo();
    expect(api.list.map((s) => [s.id, s.state])).toEqual([['s1', 'running']]);
    expect(socket.opened).toHaveLength(1);
    expect(store.active.value).toBe(true);
  });

  it('hands simpler surfaces to the picture, and takes them for no news', async () => {
    watcher.start();
    await settle();
    serve('s1', '1');
    const newsMs = store.lastMessageMs.value;
    await vi.advanceTimersByTimeAsync(500);
    socket.handlers?.onMessage({ kind: 'simpler', blocks: [] });
    expect(simplified).toBe(1);
    expect(store.lastMessageMs.value).toBe(newsMs);
  });

  it('makes a session for a hand in the browser, starts it and watches it, whatever was watched before', async () => {
    watcher.start();
    await settle();
    serve('s1', '1');
    expect(await watcher.practise()).toBe('s2');
    await settle();
    expect(api.list.map((s) => [s.id, s.state])).toEqual([
      ['s2', 'running'],
      ['s1', 'created'],
    ]);
    expect(socket.opened.at(-1)).toBe('ws://s2');
    api.down = true;
    expect(await watcher.practise()).toBeNull();
    expect(store.problem.value).toBe('no answer');
  });

  it('makes a new session for another demo after one has finished', async () => {
    watcher.start();
    await settle();
    serve('s1', '1');
    socket.handlers?.onMessage(telemetry({ state: 'finished', thrustN: new Float32Array([1]) }));
    api.list[0]!.state = 'finished';
    await settle();
    expect(store.metrics.value?.axial_thrust_mean_n).toBe(12);
    await watcher.runDemo();
    await settle();
    expect(socket.opened.at(-1)).toBe('ws://s2');
    expect(api.list[0]?.state).toBe('running');
    serve('s2', '1');
    expect(store.telemetry.value).toBeNull();
    expect(store.trace.newest('thrustN')).toBeNull();
    expect(store.metrics.value).toBeNull();
  });

  it('comes back by itself to a ready state after the server was restarted', async () => {
    watcher.start();
    await settle();
    serve('s1', '1');
    await watcher.runDemo();
    socket.handlers?.onMessage(telemetry({ state: 'running' }));
    api.down = true;
    api.list = [];
    socket.end();
    expect(store.live.value).toBe(false);
    expect(store.link.value.kind).toBe('lost');
    await vi.advanceTimersByTimeAsync(4000);
    expect(store.live.value).toBe(false);
    api.down = false;
    await vi.advanceTimersByTimeAsync(3000);
    expect(socket.opened.at(-1)).toBe('ws://s2');
    serve('s2', '2');
    expect(store.live.value).toBe(true);
    expect(store.sessionState.value).toBe('created');
    expect(store.telemetry.value).toBeNull();
    expect(begun).toEqual(['s1', 's2']);
  });

  it('is not live while news come too late, and is again when they come in time or nothing moves', async () => {
    watcher.start();
    await settle();
    serve('s1', '1');
    await watcher.runDemo();
    const news = (stampMs: number, receivedMs: number, state: 'running' | 'paused' = 'running') =>
      socket.handlers?.onMessage(telemetry({ state, stampMs, receivedMs }));
    news(1000, 50_000);
    news(1033, 50_034);
    expect(store.live.value).toBe(true);
    news(2000, 53_000);
    expect(store.behindMs.value).toBeCloseTo(2000, -2);
    expect(store.live.value).toBe(false);
    news(5000, 54_010);
    expect(store.live.value).toBe(true);
    news(6000, 57_500);
    expect(store.live.value).toBe(false);
    news(6001, 58_500, 'paused');
    expect(store.live.value).toBe(true);
  });

  it('is not live again before the whole picture has come', async () => {
    watcher.start();
    await settle();
    serve('s1', '1');
    socket.end();
    await vi.advanceTimersByTimeAsync(300);
    socket.handlers?.onMessage(hello({ sessionId: 's1' }));
    expect(store.link.value.kind).toBe('live');
    expect(store.live.value).toBe(false);
    socket.handlers?.onMessage(wholePicture);
    expect(store.live.value).toBe(true);
  });

  it('follows a session that somebody else started', async () => {
    watcher.start();
    await settle();
    serve('s1', '1');
    const other = await api.createDemo();
    await api.start(other.id);
    await vi.advanceTimersByTimeAsync(3000);
    expect(socket.opened.at(-1)).toBe(`ws://${other.id}`);
  });

  it('leaves a listed session aside that gives no stream', async () => {
    api.list = [{ ...(await api.createDemo()), state: 'finished' }];
    watcher.start();
    await settle();
    expect(socket.opened).toEqual(['ws://s1']);
    socket.end();
    await vi.advanceTimersByTimeAsync(250);
    socket.end();
    await vi.advanceTimersByTimeAsync(500);
    expect(socket.opened.at(-1)).toBe('ws://s2');
  });

  it('tells in words what did not work', async () => {
    watcher.start();
    await settle();
    serve('s1', '1');
    api.start = () => Promise.reject(new ApiError('4 sessions are live; stop one first', 503));
    await watcher.runDemo();
    expect(store.problem.value).toBe('4 sessions are live; stop one first');
    expect(store.busy.value).toBe(false);
  });

  it('pauses and goes on, and begins anew on another session that it then watches', async () => {
    watcher.start();
    await settle();
    serve('s1', '1');
    await watcher.runDemo();
    await watcher.pause(true);
    expect(store.sessionState.value).toBe('paused');
    expect(store.details.value?.held).toBe(true);
    await watcher.pause(false);
    expect(store.sessionState.value).toBe('running');
    expect(store.live.value).toBe(true);
    expect(await watcher.reset()).toBe('s2');
    expect(store.live.value).toBe(false);
    await settle();
    expect(api.list.map((s) => [s.id, s.state])).toEqual([
      ['s2', 'running'],
      ['s1', 'stopped'],
    ]);
    expect(socket.opened.at(-1)).toBe('ws://s2');
  });

  it('makes a session of a study', async () => {
    watcher.start();
    await settle();
    serve('s1', '1');
    expect(await watcher.train('study', null, 'demo')).toMatchObject({
      id: 's2',
      study: 'study',
      participant: 'K7-F3M',
    });
    expect(api.list[0]).toMatchObject({ id: 's2', state: 'running' });
    api.down = true;
    expect(await watcher.train('study', null, 'demo')).toBeNull();
  });

  it('stays with a session that the user chose, though another is started', async () => {
    watcher.start();
    await settle();
    const mine = await api.createDemo();
    watcher.watch(mine.id);
    await settle();
    expect(socket.opened.at(-1)).toBe(`ws://${mine.id}`);
    serve(mine.id, '1');
    const other = await api.createDemo();
    await api.start(other.id);
    await vi.advanceTimersByTimeAsync(6000);
    expect(socket.opened.at(-1)).toBe(`ws://${mine.id}`);
    await watcher.runDemo();
    expect(store.chosenId.value).toBeNull();
  });

  it('sees nothing where it may not make a session, until there is one', async () => {
    const viewer = new Watcher(
      store,
      api as unknown as Api,
      socket,
      { begin: () => undefined, apply: () => undefined, simplify: () => undefined, setTool: () => undefined },
      { makesSession: () => false },
    );
    api.prepared = false;
    viewer.start();
    await settle();
    expect(store.link.value).toMatchObject({ kind: 'lost', reason: 'still preparing' });
    api.prepared = true;
    await vi.advanceTimersByTimeAsync(300);
    expect(api.list).toEqual([]);
    expect(store.link.value.kind).toBe('nothing');
    expect(store.live.value).toBe(false);
    await api.createDemo();
    await vi.advanceTimersByTimeAsync(2600);
    expect(socket.opened.at(-1)).toBe('ws://s1');
    serve('s1', '1');
    expect(store.live.value).toBe(true);
    viewer.rest();
  });

  it('rests when nobody may watch any more: nothing is live, nothing is asked', async () => {
    watcher.start();
    await settle();
    serve('s1', '1');
    expect(store.live.value).toBe(true);
    watcher.rest();
    expect(store.live.value).toBe(false);
    expect(socket.handlers).toBeNull();
    const opened = socket.opened.length;
    await vi.advanceTimersByTimeAsync(10_000);
    expect(socket.opened).toHaveLength(opened);
    watcher.start();
    await settle();
    serve('s1', '1');
    expect(store.live.value).toBe(true);
  });

  describe('with a recording', () => {
    const replayOf = (sessionId: string) => {
      socket.handlers?.onMessage(
        hello({ sessionId: `r${sessionId}`, serverEpoch: '1', replayOf: sessionId, durationTicks: 10000 }),
      );
      socket.handlers?.onMessage(wholePicture);
    };
    const playback = (positionTicks: number, jump: number, thrustN: number[] = []) =>
      socket.handlers?.onMessage(
        telemetry({
          state: 'replaying',
          firstTick: positionTicks - thrustN.length,
          thrustN: new Float32Array(thrustN),
          playback: { positionTicks, speed: 1, playing: true, jump },
        }),
      );
    const open = async () => {
      watcher.start();
      await settle();
      serve('s1', '1');
      api.list[0]!.state = 'stopped';
      await watcher.openReplay('s1');
      await settle();
      replayOf('s1');
    };

    it('watches the replay and never calls it live', async () => {
      await open();
      expect(socket.opened.at(-1)).toBe('ws://rs1');
      expect(store.replaying.value).toBe(true);
      expect(store.upToDate.value).toBe(true);
      expect(store.live.value).toBe(false);
      expect(store.marks.value.map((mark) => mark.at_s)).toEqual([2]);
      expect(store.metrics.value).toBeNull();
    });

    it('keeps no line and no value across a jump', async () => {
      await open();
      playback(5000, 0, [50, 51]);
      playback(5002, 0, [52, 53]);
      expect(store.trace.line('thrustN', 20, 100_000).values).toEqual([50, 51, 52, 53]);
      playback(1000, 1, [7]);
      playback(1001, 1, [8]);
      expect(store.trace.line('thrustN', 20, 100_000)).toEqual({ seconds: [0.999, 1], values: [7, 8] });
    });

    it('stays with it though a session is started elsewhere, and comes back when asked to', async () => {
      await open();
      const other = await api.createDemo();
      await api.start(other.id);
      await vi.advanceTimersByTimeAsync(3000);
      expect(socket.opened.at(-1)).toBe('ws://rs1');
      expect(store.sessions.value.map((session) => session.id)).toContain(other.id);
      watcher.leaveReplay();
      await settle();
      expect(socket.opened.at(-1)).toBe(`ws://${other.id}`);
      expect(store.live.value).toBe(false);
      serve(other.id, '1');
      expect(store.live.value).toBe(true);
      expect(store.playback.value).toBeNull();
    });

    it('goes to moments and says so to the server', async () => {
      await open();
      playback(0, 0);
      watcher.scrubber.seek(4);
      await watcher.play({ playing: true });
      expect(api.changes).toEqual([{ position_s: 4 }, { playing: true }]);
      api.changePlayback = () => Promise.reject(new ApiError('position_s is past the end', 422));
      watcher.scrubber.seek(40);
      await settle();
      expect(store.problem.value).toBe('position_s is past the end');
    });

    it('says that the recording is damaged, also when the server finds it later', async () => {
      await open();
      expect(store.recordingWarning.value).toBeNull();
      api.replays[0]!.warning = 'damaged after 1.75 s';
      await watcher.play({ playing: true });
      expect(store.recordingWarning.value).toBe('damaged after 1.75 s');
      watcher.leaveReplay();
      expect(store.recordingWarning.value).toBeNull();
    });

    it('goes back to what is live, in words, when the replay was ended', async () => {
      await open();
      playback(0, 0);
      api.replays = [];
      socket.handlers?.onMessage(
        telemetry({ state: 'stopped', playback: { positionTicks: 0, speed: 1, playing: false, jump: 0 } }),
      );
      await settle();
      expect(store.replayId.value).toBeNull();
      expect(store.problem.value).toContain('replay has ended');
      expect(socket.opened.at(-1)).toBe('ws://s1');
    });

    it('takes up a replay again after the link was lost, and lets go of one that is gone', async () => {
      await open();
      socket.end();
      await vi.advanceTimersByTimeAsync(300);
      expect(socket.opened.at(-1)).toBe('ws://rs1');
      replayOf('s1');
      api.replays = [];
      socket.end();
      await vi.advanceTimersByTimeAsync(600);
      expect(socket.opened.at(-1)).toBe('ws://s1');
      expect(store.problem.value).toContain('replay has ended');
    });
  });

  it('does not take a session that rests for live when the server answers no more', async () => {
    watcher.start();
    await settle();
    serve('s1', '1');
    await vi.advanceTimersByTimeAsync(1);
    expect(store.live.value).toBe(true);
    api.down = true;
    await vi.advanceTimersByTimeAsync(2600);
    expect(store.link.value).toMatchObject({ kind: 'lost', reason: 'no answer' });
    expect(store.live.value).toBe(false);
    api.down = false;
    await vi.advanceTimersByTimeAsync(600);
    serve('s1', '1');
    expect(store.live.value).toBe(true);
  });

  it('notices a connection that is cut without a word while the session rests', async () => {
    watcher.start();
    await settle();
    serve('s1', '1');
    api.sessions = () => new Promise(() => undefined);
    await vi.advanceTimersByTimeAsync(2600);
    expect(store.live.value).toBe(true);
    await vi.advanceTimersByTimeAsync(8100);
    expect(store.link.value.kind).toBe('lost');
  });

  it('believes a stream that goes on, whatever becomes of questions', async () => {
    watcher.start();
    await settle();
    serve('s1', '1');
    await watcher.runDemo();
    api.down = true;
    for (let i = 0; i < 40; ++i) {
      await vi.advanceTimersByTimeAsync(100);
      const at = telemetry({ state: 'running', tick: i, thrustN: new Float32Array([1]) });
      socket.handlers?.onMessage(at);
    }
    expect(store.live.value).toBe(true);
  });

  it('says that the watched session has been deleted, and shows another', async () => {
    watcher.start();
    await settle();
    serve('s1', '1');
    await watcher.runDemo();
    await watcher.stop();
    watcher.watch('s1');
    await settle();
    serve('s1', '1');
    api.list = api.list.filter((session) => session.id !== 's1');
    await vi.advanceTimersByTimeAsync(2600);
    expect(store.problem.value).toContain('s1');
    expect(store.problem.value).toContain('deleted');
    expect(store.live.value).toBe(false);
    expect(socket.opened.at(-1)).toBe('ws://s2');
    expect(store.chosenId.value).toBeNull();
  });

  it('watches an older session that the first page of the list does not have', async () => {
    watcher.start();
    await settle();
    serve('s1', '1');
    const old = await api.createDemo();
    const { sessions } = api;
    api.sessions = async () => (await sessions()).filter((session) => session.id !== old.id);
    watcher.watch(old.id);
    await settle();
    expect(socket.opened.at(-1)).toBe(`ws://${old.id}`);
    expect(store.problem.value).toBeNull();
  });

  it('misses no session that nobody had started', async () => {
    watcher.start();
    await settle();
    serve('s1', '1');
    api.list = [];
    await vi.advanceTimersByTimeAsync(2600);
    expect(store.problem.value).toBeNull();
    expect(socket.opened.at(-1)).toBe('ws://s2');
  });
});
