import { describe, expect, it } from 'vitest';

import { Scrubber } from '../../src/state/scrubber';

/** A server that answers when the test lets it. */
class SlowServer {
  readonly requests: number[] = [];
  private readonly waiting: { done: () => void; refuse: (error: Error) => void }[] = [];
  send = (positionS: number) => {
    this.requests.push(positionS);
    return new Promise<void>((done, refuse) => this.waiting.push({ done, refuse }));
  };
  async answer(): Promise<void> {
    this.waiting.shift()?.done();
    await Promise.resolve();
    await Promise.resolve();
  }
  async refuse(): Promise<void> {
    this.waiting.shift()?.refuse(new Error('past the end'));
    await Promise.resolve();
    await Promise.resolve();
  }
}

function scene() {
  const server = new SlowServer();
  const problems: unknown[] = [];
  const scrubber = new Scrubber(server.send, (problem) => problems.push(problem));
  return { server, problems, scrubber };
}

describe('Scrubber', () => {
  it('sends one position at a time, and of those wanted meanwhile only the newest', async () => {
    const { server, scrubber } = scene();
    for (const s of [1, 2, 3, 4]) scrubber.seek(s);
    expect(server.requests).toEqual([1]);
    await server.answer();
    expect(server.requests).toEqual([1, 4]);
    await server.answer();
    expect(server.requests).toEqual([1, 4]);
    scrubber.seek(5);
    expect(server.requests).toEqual([1, 4, 5]);
  });

  it('shows what is wanted until the stream speaks after the answer', async () => {
    const { server, scrubber } = scene();
    scrubber.seek(7);
    scrubber.onStreamUpdate();
    expect(scrubber.wantedS.value).toBe(7);
    await server.answer();
    expect(scrubber.wantedS.value).toBe(7);
    scrubber.onStreamUpdate();
    expect(scrubber.wantedS.value).toBeNull();
  });

  it('tells a refusal and goes back to what the stream shows', async () => {
    const { server, problems, scrubber } = scene();
    scrubber.seek(1);
    scrubber.seek(2);
    await server.refuse();
    expect(problems).toHaveLength(1);
    expect(scrubber.wantedS.value).toBeNull();
    expect(server.requests).toEqual([1]);
  });
});
