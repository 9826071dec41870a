import type { SessionState } from '../wire/messages';
import type { Session } from '../wire/rest_types';

interface Watched {
  state: SessionState | null;
  /** Paused by a command, not by the hand. */
  held: boolean;
  /** In the hand on this page, which has a button of its own to pause. */
  steered: boolean;
  /** It was in the hand on a page that has gone. */
  pageLost: boolean;
}

export interface SessionChoices {
  pause: 'pause' | 'resume' | null;
  startAgain: boolean;
  /** The page that controlled it is gone: anybody may continue or end it. */
  left: boolean;
}

/** Of what REST says of the session. */
export const isPageLost = ({ device }: Pick<Session, 'device'>): boolean =>
  device.name === 'browser' && device.state === 'lost';

/** What can be done with a session that is under way; with one that has ended, nothing: another one is begun. */
export function sessionChoices({ state, held, steered, pageLost }: Watched): SessionChoices {
  const active = state === 'running' || state === 'paused';
  if (!active) return { pause: null, startAgain: false, left: false };
  const mayPause = state === 'running' && !steered;
  const left = state === 'paused' && !held && !steered && pageLost;
  return { pause: held ? 'resume' : mayPause ? 'pause' : null, startAgain: !left, left };
}
