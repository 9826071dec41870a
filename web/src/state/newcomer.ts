import type { Session } from '../wire/rest_types';

/** Who uses the page, as far as this matters. */
interface Person {
  /** Null on a server without users. */
  userId: string | null;
  /** Sessions of staff are nobody's. */
  teach: boolean;
}

/** Whether this person has reamed by hand before, as far as the sessions say. */
export function hasReamed(sessions: readonly Session[], { userId, teach }: Person): boolean {
  return sessions.some(({ device, state, trainee_id: trainee }) => {
    if (device.name === 'script' || state === 'created') return false;
    return userId === null || trainee === userId || (teach && trainee === null);
  });
}
