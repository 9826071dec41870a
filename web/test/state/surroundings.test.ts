import { signal } from '@preact/signals';
import { describe, expect, it } from 'vitest';

import { type SurfaceSource, Surroundings } from '../../src/state/surroundings';
import type { Hello } from '../../src/wire/messages';
import type { Surface } from '../../src/wire/ply';
import { hello } from '../wire/fake_messages';

const surface = (): Surface => ({
  positions: new Float32Array(),
  normals: new Float32Array(),
  indices: new Uint32Array(),
  low: [0, 0, 0],
  high: [0, 0, 0],
});

/** Answers when it is told to. */
class FakeSource implements SurfaceSource {
  readonly asked: { url: string; answer: (of: Surface | null) => void; fail: (why: Error) => void }[] = [];
  disposed = false;
  load(url: string): Promise<Surface | null> {
    return new Promise((answer, fail) => this.asked.push({ url, answer, fail }));
  }
  dispose(): void {
    this.disposed = true;
  }
}

function watched() {
  const source = new FakeSource();
  const shown: (Surface | null)[] = [];
  const store = { hello: signal<Hello | null>(null) };
  const wanted = signal(true);
  const picture = { showSurroundings: (of: Surface | null) => void shown.push(of) };
  const surroundings = new Surroundings(store, picture, source, () => wanted.value, 'http://here');
  const open = (caseId: string) => {
    const message = hello({ caseId });
    if (message.kind === 'hello') store.hello.value = message.hello;
  };
  return { source, shown, wanted, surroundings, open };
}

const settled = () => new Promise<void>((done) => setTimeout(done));

describe('what lies around the bone', () => {
  it('is fetched once for each case that is shown', async () => {
    const { source, shown, open } = watched();
    expect(source.asked).toEqual([]);
    open('a b');
    open('a b');
    expect(source.asked.map(({ url }) => url)).toEqual(['http://here/api/v1/cases/a%20b/surroundings']);
    const first = surface();
    source.asked[0]?.answer(first);
    await settled();
    expect(shown.at(-1)).toBe(first);
    open('c');
    expect(shown.at(-1)).toBeNull();
    expect(source.asked.length).toBe(2);
  });

  it('is never that of another case, however late it comes', async () => {
    const { source, shown, open } = watched();
    open('a');
    open('c');
    source.asked[0]?.answer(surface());
    await settled();
    expect(shown.every((of) => of === null)).toBe(true);
  });

  it('is not asked for of plates of a study of feel', () => {
    const { source, open } = watched();
    open('two-plates-0a1b2c3d');
    expect(source.asked).toEqual([]);
  });

  it('is left out where there is none, and where it is not wanted', async () => {
    const { source, shown, wanted, surroundings, open } = watched();
    open('a');
    source.asked[0]?.fail(new Error('404'));
    await settled();
    expect(shown.every((of) => of === null)).toBe(true);
    wanted.value = false;
    open('c');
    expect(source.asked.length).toBe(1);
    wanted.value = true;
    expect(source.asked.length).toBe(2);
    surroundings.dispose();
    expect(source.disposed).toBe(true);
  });
});
