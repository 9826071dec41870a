import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import {
  LiveBoard,
  type LiveSource,
  pictureEveryMs,
  readEveryMs,
  staleAfterMs,
} from '../../../src/state/dashboard/live_board';
import type { Session, Metrics } from '../../../src/wire/rest_types';
import { ApiError } from '../../../src/wire/rest';

const session = (id: string, caseId = 'demo') => ({ id, case: caseId, state: 'running', tick: 1 }) as Session;

class FakeSource implements LiveSource {
  sessions: Session[] = [session('a')];
  fails: Error | null = null;
  silent = false;
  depthMm = 0;
  requests: string[] = [];
  pictureFails = false;

  live = (): Promise<Session[]> => this.answer(this.sessions);
  soFar = (): Promise<Metrics> => this.answer({ reaming_depth_mm: (this.depthMm += 1) } as Metrics);
  plannedDepthMm = (caseId: string): Promise<number | null> => {
    this.requests.push(`plan ${caseId}`);
    return this.answer(2.5);
  };
  picture = (id: string): Promise<Blob> => {
    this.requests.push(`picture ${id}`);
    return this.pictureFails ? Promise.reject(new ApiError('busy', 503)) : this.answer({} as Blob);
  };

  private answer<T>(value: T): Promise<T> {
    if (this.silent) return new Promise(() => undefined);
    return this.fails === null ? Promise.resolve(value) : Promise.reject(this.fails);
  }
}

describe('LiveBoard', () => {
  let source: FakeSource;
  let board: LiveBoard;
  let kept: Set<string>;
  let made: number;
  const pass = (ms: number) => vi.advanceTimersByTimeAsync(ms);

  beforeEach(async () => {
    vi.useFakeTimers();
    source = new FakeSource();
    kept = new Set();
    made = 0;
    board = new LiveBoard(
      source,
      () => {
        const address = `blob:${++made}`;
        kept.add(address);
        return address;
      },
      (address) => kept.delete(address),
    );
    board.start();
    await pass(0);
  });
  afterEach(() => {
    board.stop();
    vi.useRealTimers();
  });

  it('shows what is under way with figures, plan and picture, and reads them again', async () => {
    const [first] = board.tiles.value;
    expect(first).toMatchObject({
      soFar: { reaming_depth_mm: 1 },
      before: null,
      plannedDepthMm: 2.5,
      picture: 'blob:1',
    });
    await pass(readEveryMs);
    expect(board.tiles.value[0]).toMatchObject({ soFar: { reaming_depth_mm: 2 }, before: { reaming_depth_mm: 1 } });
    expect(source.requests).toEqual(['plan demo', 'picture a']);
    expect(board.stale.value).toBe(false);
  });

  it('is stale as soon as the server does not answer, with its words, and recovers', async () => {
    source.fails = new ApiError('The simulator does not respond.', 0);
    await pass(readEveryMs);
    expect(board.stale.value).toBe(true);
    expect(board.problem.value).toBe('The simulator does not respond.');
    expect(board.tiles.value).toHaveLength(1);
    source.fails = null;
    await pass(readEveryMs);
    expect([board.stale.value, board.problem.value]).toEqual([false, null]);
  });

  it('is stale at once when news stop, and when an answer never comes', async () => {
    source.silent = true;
    board.loseTouch();
    expect(board.stale.value).toBe(true);
    source.silent = false;
    board.stop();
    board.start();
    await pass(0);
    expect(board.stale.value).toBe(false);
    source.silent = true;
    await pass(staleAfterMs + 1000);
    expect(board.stale.value).toBe(true);
  });

  it('takes the figures of one session for old when they fail while the list does not', async () => {
    source.soFar = () => Promise.reject(new ApiError('no', 500));
    await pass(staleAfterMs + 2 * readEveryMs);
    expect(board.stale.value).toBe(false);
    expect(board.tiles.value.map((tile) => board.isOld(tile))).toEqual([true]);
  });

  it('asks for pictures one after the other and of each not too often, and keeps none it does not show', async () => {
    source.sessions = [session('a'), session('b'), session('c')];
    await pass(3 * readEveryMs);
    expect(source.requests.filter((one) => one.startsWith('picture'))).toEqual(['picture a', 'picture b', 'picture c']);
    await pass(pictureEveryMs);
    expect(source.requests.filter((one) => one === 'picture a')).toHaveLength(2);
    expect(kept.size).toBe(3);
    source.sessions = [session('b')];
    await pass(readEveryMs);
    expect(kept.size).toBe(1);
    board.stop();
    expect(kept.size).toBe(0);
    expect(board.tiles.value).toEqual([]);
  });

  it('keeps the picture it has when another cannot be had', async () => {
    source.pictureFails = true;
    await pass(pictureEveryMs + readEveryMs);
    expect(board.tiles.value[0]?.picture).toBe('blob:1');
  });

  it('heeds no answer that comes after it was left', async () => {
    board.stop();
    let answer: (sessions: Session[]) => void = () => undefined;
    source.live = () => new Promise((resolve) => (answer = resolve));
    board.start();
    board.stop();
    answer([session('late')]);
    await pass(0);
    expect(board.tiles.value).toEqual([]);
  });
});
