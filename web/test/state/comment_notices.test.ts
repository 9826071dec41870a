import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { CommentNotices, noticedForMs } from '../../src/state/comment_notices';
import { LiveAnnotations } from '../../src/state/live_annotations';
import { PracticeStore } from '../../src/state/practice_store';
import { Store } from '../../src/state/store';
import type { Change, ChangeHandlers } from '../../src/wire/change_socket';
import type { Annotation } from '../../src/wire/rest_types';
import { someAnnotation } from '../wire/some_answers';

const by = (author: string, words: string, at_s = 1): Annotation => ({ ...someAnnotation(at_s, words), author });

function place() {
  const store = new Store();
  store.sessionId.value = 's1';
  store.sessionState.value = 'running';
  const practice = new PracticeStore(store);
  const kept: Annotation[] = [];
  const api = {
    annotations: vi.fn(() => Promise.resolve([...kept])),
    annotate: (_: string, words: string) => {
      const made = by('', words, 3);
      kept.push(made);
      return Promise.resolve(made);
    },
  };
  let handlers: ChangeHandlers | null = null;
  const annotations = new LiveAnnotations(store, api, (given) => ({
    start: () => void (handlers = given),
    stop: () => void (handlers = null),
  }));
  const notices = new CommentNotices({ store, practice, annotations, ownNames: () => ['', 'Tom', '7K-2QX'] });
  const said = () => notices.shown.value.map(({ comment }) => comment.words);
  const hear = async (...comments: Annotation[]) => {
    kept.push(...comments);
    const change: Change = { kind: 'session', number: 1, id: 's1', change: 'annotated' };
    handlers?.onChange(change);
    await vi.advanceTimersByTimeAsync(0);
  };
  return { store, practice, annotations, notices, kept, api, said, hear, listens: () => handlers !== null };
}

beforeEach(() => vi.useFakeTimers());
afterEach(() => vi.useRealTimers());

describe('Comments over the picture', () => {
  it('come at once when somebody else comments on what is steered here, and go away again', async () => {
    const { practice, said, hear, listens } = place();
    await hear();
    practice.sessionId.value = 's1';
    expect(listens()).toBe(true);
    await hear();
    await hear(by('Ines', 'Tilt less'));
    expect(said()).toEqual(['Tilt less']);
    await vi.advanceTimersByTimeAsync(noticedForMs - 1);
    expect(said()).toEqual(['Tilt less']);
    await vi.advanceTimersByTimeAsync(1);
    expect(said()).toEqual([]);
  });

  it('are none for what was said before, and none for who only watches', async () => {
    const { practice, said, hear, listens, kept } = place();
    kept.push(by('Ines', 'of before'));
    await hear();
    expect(listens()).toBe(false);
    practice.sessionId.value = 's1';
    await hear();
    expect(said()).toEqual([]);
    await hear(by('Ines', 'now'));
    expect(said()).toEqual(['now']);
    practice.sessionId.value = null;
    expect(said()).toEqual([]);
    expect(listens()).toBe(false);
  });

  it('are none for one’s own, by this page or by another one of the same person', async () => {
    const { practice, annotations, said, hear } = place();
    practice.sessionId.value = 's1';
    await hear();
    expect(await annotations.keep('mine')).toBe(true);
    await vi.advanceTimersByTimeAsync(0);
    await hear(by('Tom', 'also mine'), by('7K-2QX', 'mine in the study'));
    expect(said()).toEqual([]);
    // Where nobody logs in, nobody signs.
    await hear(by('', 'of another page'));
    expect(said()).toEqual(['of another page']);
  });

  it('are at most three, and each can be dismissed', async () => {
    const { practice, notices, said, hear } = place();
    practice.sessionId.value = 's1';
    await hear();
    await hear(...['a', 'b', 'c', 'd'].map((words) => by('Ines', words)));
    expect(said()).toEqual(['b', 'c', 'd']);
    notices.dismiss(notices.shown.value[1]?.number ?? 0);
    expect(said()).toEqual(['b', 'd']);
  });

  it('still come where the server cannot say so at once', async () => {
    const { store, practice, said, hear, kept } = place();
    store.link.value = { kind: 'live' };
    store.pictureComplete.value = true;
    practice.sessionId.value = 's1';
    await hear();
    kept.push(by('Ines', 'late'));
    await vi.advanceTimersByTimeAsync(5000);
    expect(said()).toEqual(['late']);
  });
});
