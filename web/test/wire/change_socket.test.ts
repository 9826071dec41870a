import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { type Change, ChangeSocket } from '../../src/wire/change_socket';

class FakeSocket {
  onmessage: ((event: MessageEvent) => void) | null = null;
  onclose: ((event: CloseEvent) => void) | null = null;
  closed = false;
  constructor(readonly url: string) {}
  close(): void {
    this.closed = true;
  }
  say(text: string): void {
    this.onmessage?.({ data: text } as MessageEvent);
  }
  end(): void {
    this.onclose?.({} as CloseEvent);
  }
}

describe('ChangeSocket', () => {
  let opened: FakeSocket[];
  let heard: Change[];
  let lost: number;
  let socket: ChangeSocket;

  beforeEach(() => {
    vi.useFakeTimers();
    opened = [];
    heard = [];
    lost = 0;
    socket = new ChangeSocket(
      'https://lab:8443',
      { onChange: (change) => heard.push(change), onLost: () => ++lost },
      (url) => {
        const made = new FakeSocket(url);
        opened.push(made);
        return made;
      },
    );
    socket.start();
  });
  afterEach(() => vi.useRealTimers());

  it('listens where the page came from, by the same kind of connection', () => {
    expect(opened.map(({ url }) => url)).toEqual(['wss://lab:8443/api/v1/events']);
  });

  it('hands on what can be read, and nothing else', () => {
    for (const text of ['{"kind":"hello","number":3,"missed":false}', 'nonsense', 'null', '{"kind":"session"}'])
      opened[0]?.say(text);
    opened[0]?.say('{"kind":"session","number":4,"utc":"","id":"a1","change":"running"}');
    expect(heard.map(({ kind, number }) => [kind, number])).toEqual([
      ['hello', 3],
      ['session', 4],
    ]);
  });

  it('says that it is lost and connects again, ever more slowly, until it is stopped', () => {
    opened[0]?.end();
    expect(lost).toBe(1);
    vi.advanceTimersByTime(260);
    expect(opened).toHaveLength(2);
    opened[1]?.end();
    vi.advanceTimersByTime(260);
    expect(opened).toHaveLength(2);
    vi.advanceTimersByTime(300);
    expect(opened).toHaveLength(3);
    opened[2]?.say('{"kind":"hello","number":0}');
    socket.stop();
    expect(opened[2]?.closed).toBe(true);
    opened[2]?.end();
    vi.advanceTimersByTime(60_000);
    expect([lost, opened.length]).toEqual([2, 3]);
  });
});
