import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { reviewText } from '../../../src/text/review_text';
import { ReviewSession, type ReviewSources } from '../../../src/state/review/review_session';
import { ApiError } from '../../../src/wire/api';
import type { PlaybackChange, Score, Session } from '../../../src/wire/rest_types';
import type { SortedSurface } from '../../../src/wire/sorted_surface';
import { hello, telemetry, wholePicture } from '../../wire/fake_messages';
import { FakeSocket } from '../../wire/fake_socket';
import { someAnnotation, someReplay } from '../../wire/some_answers';

const code = { stepMm: 1 / 32, rangeMm: 127 / 32, unknown: -128 };
const corners = 4;

function begin(change: Partial<ReviewSources['review']> = {}) {
  const socket = new FakeSocket();
  const changes: PlaybackChange[] = [];
  const requests: string[] = [];
  const annotations = [someAnnotation(5, 'here')];
  const replay = someReplay({ marks: [{ at_s: 5, kind: 'annotation', words: 'here' }] });
  const details = { id: 'abcd', tick: 10_000, duration_s: 10, state: 'finished', case: 'demo' } as Session;
  const sources: ReviewSources = {
    api: {
      openReplay: () => Promise.resolve(replay),
      replay: () => Promise.resolve(replay),
      changePlayback: (_, what) => {
        changes.push(what);
        return Promise.resolve(replay);
      },
      streamUrl: (id) => id,
    },
    review: {
      session: () => Promise.resolve(details),
      score: () => Promise.resolve({ points: 92, metrics: [] } as unknown as Score),
      trace: (_, stride) => {
        requests.push(`trace ${stride}`);
        return Promise.resolve('t_s,thrust_n,spindle_on\n0,0,0\n1,0,1\n2,40,1\n3,0,1\n');
      },
      deviation: (_, to) => {
        requests.push(to);
        return Promise.resolve({ bytes: new Int8Array(corners), code });
      },
      annotations: () => Promise.resolve(annotations),
      annotate: (_, text, atS) => {
        const made = someAnnotation(atS, text);
        annotations.push(made);
        return Promise.resolve(made);
      },
      ...change,
    },
    socket,
    surface: () => {
      requests.push('surface');
      return Promise.resolve({ positions: new Float32Array(corners * 3) } as unknown as SortedSurface);
    },
    mayReadTrace: true,
  };
  const picture = {
    begin: () => undefined,
    apply: () => undefined,
    simplify: () => undefined,
    setTool: () => undefined,
  };
  const session = new ReviewSession('abcd', sources, picture);
  session.start();
  return { session, socket, changes, requests, sources };
}

const settle = () => vi.advanceTimersByTimeAsync(0);
const standsAt = (socket: FakeSocket, positionTicks: number) =>
  socket.handlers?.onMessage(
    telemetry({ state: 'replaying', playback: { positionTicks, speed: 1, playing: false, jump: 1 } }),
  );

async function opened(change: Partial<ReviewSources['review']> = {}) {
  const all = begin(change);
  await settle();
  all.socket.handlers?.onMessage(hello({ replayOf: 'abcd', durationTicks: 10_000 }));
  all.socket.handlers?.onMessage(wholePicture);
  standsAt(all.socket, 0);
  await settle();
  return all;
}

describe('session under review', () => {
  beforeEach(() => void vi.useFakeTimers());
  afterEach(() => void vi.useRealTimers());

  it('knows before and after, and goes from one to the other', async () => {
    const { session, socket, changes } = await opened();
    expect([session.atStart.value, session.atEnd.value]).toEqual([true, false]);
    session.toggleBefore();
    await settle();
    expect(changes).toContainEqual({ position_s: 10 });
    standsAt(socket, 10_000);
    expect([session.atStart.value, session.atEnd.value]).toEqual([false, true]);
    session.toggleBefore();
    await settle();
    expect(changes.at(-1)).toEqual({ position_s: 0 });
    session.dispose();
  });

  it('has marks of the recording and of the forces on one timeline, and goes from one to the next', async () => {
    const { session, socket, changes } = await opened();
    expect(session.marks.value.map(({ kind }) => kind)).toEqual(['spindle-on', 'contact', 'withdrawn', 'annotation']);
    session.seekEvent(true);
    await settle();
    expect(changes.at(-1)).toEqual({ position_s: 1 });
    standsAt(socket, 4000);
    session.seekEvent(false);
    await settle();
    expect(changes.at(-1)).toEqual({ position_s: 3 });
    session.dispose();
  });

  it('shows a map at the end only, where choosing one leads', async () => {
    const { session, socket, changes, requests } = await opened();
    session.chooseMap('plan');
    await settle();
    expect(changes).toContainEqual({ position_s: 10 });
    expect(session.mapShown.value).toBeNull();
    standsAt(socket, 10_000);
    expect(session.mapShown.value?.name).toBe('plan');
    standsAt(socket, 3000);
    expect(session.mapShown.value).toBeNull();
    standsAt(socket, 10_000);
    session.nextMap();
    await settle();
    expect(session.mapShown.value?.name).toBe('implant');
    session.nextMap();
    await settle();
    expect(session.mapShown.value?.name).toBe('wall');
    session.nextMap();
    expect(session.mapShown.value).toBeNull();
    session.chooseMap('plan');
    await settle();
    // What was fetched is kept.
    expect(requests.filter((what) => what !== 'trace 17')).toEqual(['plan', 'surface', 'implant', 'wall']);
    session.dispose();
  });

  it('says in words why a map is not there, and tries again', async () => {
    let status = 404;
    const { session } = await opened({
      deviation: (_, to) =>
        status === 0
          ? Promise.resolve({ bytes: new Int8Array(corners), code })
          : Promise.reject(new ApiError(`nothing for ${to}`, status)),
    });
    for (status of [403, 404, 422, 500]) {
      session.chooseMap('plan');
      await settle();
      const state = session.map.state.value;
      expect(state.kind).toBe('problem');
      expect(state.kind === 'problem' && state.message.length).toBeGreaterThan(20);
    }
    status = 0;
    session.chooseMap('plan');
    await settle();
    expect(session.map.state.value.kind).toBe('ready');
    session.dispose();
  });

  it('does not paint a map on a surface that it does not fit', async () => {
    const { session } = await opened({
      deviation: () => Promise.resolve({ bytes: new Int8Array(corners + 1), code }),
    });
    session.chooseMap('implant');
    await settle();
    expect(session.map.state.value).toMatchObject({ kind: 'problem', message: reviewText.noMap.mismatch });
    session.dispose();
  });

  it('notices that it was deleted meanwhile, shows nothing more of it, and comes back when it is restored', async () => {
    let gone = false;
    const details = { id: 'abcd', tick: 10_000, duration_s: 10, state: 'finished' } as Session;
    const { session, socket } = await opened({
      session: () => (gone ? Promise.reject(new ApiError('no session', 404)) : Promise.resolve(details)),
    });
    expect(session.error.value).toBeNull();
    gone = true;
    await vi.advanceTimersByTimeAsync(10_000);
    expect(session.error.value?.kind).toBe('gone');
    expect(session.store.upToDate.value).toBe(false);
    expect(socket.handlers).toBeNull();
    gone = false;
    await vi.advanceTimersByTimeAsync(10_000);
    expect(session.error.value).toBeNull();
    expect(socket.handlers).not.toBeNull();
    session.dispose();
  });

  it('keeps remarks on the moment that is shown', async () => {
    const { session, socket } = await opened();
    standsAt(socket, 2500);
    await session.annotate('too much force');
    const kept = { at_s: 2.5, kind: 'annotation', words: 'too much force' };
    expect(session.marks.value).toContainEqual(kept);
    // The replay was opened before and does not know of it.
    session.togglePlay();
    await settle();
    expect(session.marks.value).toContainEqual(kept);
    expect(session.marks.value.filter(({ words }) => words === 'here')).toHaveLength(1);
    session.dispose();
  });

  it('asks for nothing any more once it is left', async () => {
    const { session, socket, requests } = await opened();
    session.dispose();
    const before = requests.length;
    await vi.advanceTimersByTimeAsync(60_000);
    expect(requests).toHaveLength(before);
    expect(socket.handlers).toBeNull();
  });
});
