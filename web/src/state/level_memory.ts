import { isLevelName, type LevelName } from '../practice/level';
import type { Session } from '../wire/rest_types';

const key = 'ream.level';

/**
 * The level of the session that this page steered last, also after the page was loaded anew: the server keeps only
 * whether a session is in theatre.
 */
export class LevelMemory {
  private last: { session: string; level: LevelName } | null;

  constructor(private readonly storage: Pick<Storage, 'getItem' | 'setItem'>) {
    const [session = '', level] = (storage.getItem(key) ?? '').split(' ');
    this.last = isLevelName(level) ? { session, level } : null;
  }

  keep(session: string, level: LevelName): void {
    this.last = { session, level };
    this.storage.setItem(key, `${session} ${level}`);
  }

  /** Of a session, or of the one that was started again as this one; null: not known. */
  of({ id, reset_of }: Pick<Session, 'id' | 'reset_of'>): LevelName | null {
    const { last } = this;
    return last !== null && (last.session === id || last.session === reset_of) ? last.level : null;
  }
}
