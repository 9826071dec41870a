import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { Backoff } from '../../src/wire/backoff';
import { helloWithinMs, Link, lostAfterSilenceMs, silentAfterMs, type LinkState } from '../../src/wire/link';
import type { StreamMessage } from '../../src/wire/messages';
import { hello, telemetry } from './fake_messages';
import { FakeSocket } from './fake_socket';

const settle = () => vi.advanceTimersByTimeAsync(0);

describe('Backoff', () => {
  it('grows from a quarter of a second to three seconds, and begins anew', () => {
    const backoff = new Backoff();
    expect(Array.from({ length: 6 }, () => backoff.take())).toEqual([250, 500, 1000, 2000, 3000, 3000]);
    backoff.reset();
    expect(backoff.take()).toBe(250);
  });
});

describe('Link', () => {
  let socket: FakeSocket;
  let link: Link;
  let states: LinkState[];
  let messages: StreamMessage[];
  let findStream: () => Promise<string>;
  const kind = () => states.at(-1)?.kind;

  beforeEach(() => {
    vi.useFakeTimers();
    socket = new FakeSocket();
    states = [];
    messages = [];
    findStream = () => Promise.resolve('ws://x');
    link = new Link({
      socket,
      findStream: () => findStream(),
      onState: (state) => states.push(state),
      onMessage: (message) => messages.push(message),
    });
  });
  afterEach(() => {
    link.stop();
    vi.useRealTimers();
  });

  const goLive = async () => {
    link.connect();
    await settle();
    socket.handlers?.onMessage(hello());
  };

  it('is live from the hello on, and passes messages on', async () => {
    link.connect();
    await settle();
    expect(socket.opened).toEqual(['ws://x']);
    expect(states).toEqual([]);
    socket.handlers?.onMessage(hello());
    expect(kind()).toBe('live');
    expect(messages).toHaveLength(1);
  });

  it('says at once that it is lost, and tries again with growing pauses until it is live', async () => {
    await goLive();
    findStream = () => Promise.reject(new Error('no answer'));
    socket.end('gone');
    expect(states.at(-1)).toMatchObject({ kind: 'lost', reason: 'gone', retryAtMs: Date.now() + 250 });
    const lostAt = Date.now();
    await vi.advanceTimersByTimeAsync(250);
    expect(states.at(-1)).toMatchObject({
      kind: 'lost',
      sinceMs: lostAt,
      reason: 'no answer',
      retryAtMs: lostAt + 750,
    });
    await vi.advanceTimersByTimeAsync(500);
    expect(states.at(-1)).toMatchObject({ retryAtMs: lostAt + 1750 });
    findStream = () => Promise.resolve('ws://again');
    await vi.advanceTimersByTimeAsync(1000);
    expect(socket.opened.at(-1)).toBe('ws://again');
    expect(states.at(-1)).toMatchObject({ kind: 'lost', retryAtMs: null });
    socket.handlers?.onMessage(hello());
    expect(kind()).toBe('live');
    socket.end();
    expect(states.at(-1)).toMatchObject({ retryAtMs: Date.now() + 250 });
  });

  it('calls a running session that says nothing silent, then lost', async () => {
    await goLive();
    link.expectTraffic(true);
    await vi.advanceTimersByTimeAsync(silentAfterMs - 1);
    expect(kind()).toBe('live');
    await vi.advanceTimersByTimeAsync(1);
    expect(kind()).toBe('silent');
    // The page's own work is no sign of life.
    socket.handlers?.onMessage({ kind: 'simpler', blocks: [] });
    expect(messages.at(-1)?.kind).toBe('simpler');
    expect(kind()).toBe('silent');
    socket.handlers?.onMessage(telemetry());
    expect(kind()).toBe('live');
    await vi.advanceTimersByTimeAsync(lostAfterSilenceMs);
    expect(kind()).toBe('lost');
    expect(socket.handlers).toBeNull();
  });

  it('lets a resting session be quiet', async () => {
    await goLive();
    link.expectTraffic(true);
    link.expectTraffic(false);
    await vi.advanceTimersByTimeAsync(60000);
    expect(kind()).toBe('live');
  });

  it('gives up a connection that never says hello', async () => {
    link.connect();
    await settle();
    await vi.advanceTimersByTimeAsync(helloWithinMs);
    expect(kind()).toBe('lost');
    await vi.advanceTimersByTimeAsync(250);
    expect(socket.opened).toHaveLength(2);
  });

  it('stops at a server of another revision', async () => {
    link.connect();
    await settle();
    socket.handlers?.onMessage(hello({ protocolRevision: 2 }));
    expect(states.at(-1)).toEqual({ kind: 'refused', serverRevision: 2 });
    await vi.advanceTimersByTimeAsync(60000);
    expect(socket.opened).toHaveLength(1);
    expect(messages).toEqual([]);
  });

  it('forgets an attempt that was overtaken by another', async () => {
    let release: (url: string) => void = () => undefined;
    findStream = () => new Promise((resolve) => (release = resolve));
    link.connect();
    findStream = () => Promise.resolve('ws://new');
    link.connect();
    release('ws://old');
    await settle();
    expect(socket.opened).toEqual(['ws://new']);
  });
});
