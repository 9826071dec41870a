import { effect, type ReadonlySignal, signal, untracked } from '@preact/signals';

import type { Annotation } from '../wire/rest_types';
import type { LiveAnnotations } from './live_annotations';
import type { PracticeStore } from './practice_store';
import type { Store } from './store';

/** Until it goes away again. */
export const noticedForMs = 10_000;
/** More would cover the picture; the oldest goes first. */
const noticedMost = 3;

export interface CommentNotice {
  number: number;
  comment: Annotation;
}

interface Sources {
  store: Store;
  practice: PracticeStore;
  annotations: Pick<LiveAnnotations, 'annotations' | 'read' | 'isOwn' | 'hearAtOnce'>;
  /** Names that whoever uses the page signs by. */
  ownNames: () => readonly string[];
}

/** Comments that others make on the session that this page steers, for as long as they stand over the picture. */
export class CommentNotices {
  readonly shown: ReadonlySignal<readonly CommentNotice[]>;
  private readonly notices = signal<readonly CommentNotice[]>([]);
  private number = 0;

  constructor(private readonly sources: Sources) {
    this.shown = this.notices;
    const { practice } = sources;
    effect(() => {
      const session = practice.sessionId.value;
      this.notices.value = [];
      if (session === null) return;
      return untracked(() => this.follow(session));
    });
  }

  dismiss(number: number): void {
    this.notices.value = this.notices.peek().filter((notice) => notice.number !== number);
  }

  private follow(session: string): () => void {
    const { store, annotations } = this.sources;
    // What was read before may be old: it does not tell what is new from here on.
    const old = annotations.read.value.peek();
    let known: ReadonlySet<string> | null = null;
    const stopHearing = annotations.hearAtOnce();
    const stop = effect(() => {
      const read = annotations.read.value.value;
      if (read === null || read === old || read.session !== session || store.sessionId.value !== session) return;
      const before = known;
      known = new Set(read.annotations.map(keyOf));
      if (before === null) return;
      const news = read.annotations.filter((one) => !before.has(keyOf(one)) && !this.isOwn(one));
      untracked(() => news.forEach((comment) => this.notice(comment)));
    });
    return () => {
      stop();
      stopHearing();
    };
  }

  private isOwn(comment: Annotation): boolean {
    const { annotations, ownNames } = this.sources;
    return annotations.isOwn(comment) || (comment.author !== '' && ownNames().includes(comment.author));
  }

  private notice(comment: Annotation): void {
    const number = ++this.number;
    this.notices.value = [...this.notices.peek(), { number, comment }].slice(-noticedMost);
    setTimeout(() => this.dismiss(number), noticedForMs);
  }
}

const keyOf = ({ utc, at_s, author, words }: Annotation): string => JSON.stringify([utc, at_s, author, words]);
