import type { Session } from '../wire/rest_types';

/** Whether a session is under way. */
export function isActive(session: Pick<Session, 'state'>): boolean {
  return session.state === 'running' || session.state === 'paused';
}

/** Whether a session has ended after something was recorded. */
export function canBeReplayed(session: Pick<Session, 'state' | 'tick'>): boolean {
  return session.state !== 'created' && !isActive(session) && session.tick > 0;
}

/** The session that is watched, and whether the user chose it. */
export interface Watched {
  id: string | null;
  chosen: boolean;
}

/**
 * The session to watch, or undefined when there is none: the one that the user chose, else the watched one while it is
 * under way, else the newest under way, else the watched one, else the newest of all. `unstreamable` holds ids that
 * gave no stream; sessions that are only in their folders have none.
 */
export function chooseSession(
  sessions: readonly Session[],
  watched: Watched,
  unstreamable: ReadonlySet<string>,
): Session | undefined {
  const newestFirst = sessions
    .filter((s) => s.streamable && !unstreamable.has(s.id))
    .sort((a, b) => (a.created_utc < b.created_utc ? 1 : a.created_utc > b.created_utc ? -1 : 0));
  const present = newestFirst.find((s) => s.id === watched.id);
  if (present !== undefined && (watched.chosen || isActive(present))) return present;
  return newestFirst.find(isActive) ?? present ?? newestFirst[0];
}
