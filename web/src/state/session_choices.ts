import type { SessionState } from '../wire/messages';

interface Watched {
  state: SessionState | null;
  /** Paused by a command, not by the hand. */
  held: boolean;
  /** In the hand on this page, which has a button of its own to pause. */
  steered: boolean;
}

export interface SessionChoices {
  pause: 'pause' | 'resume' | null;
  startAgain: boolean;
}

/** What can be done with a session that is under way; with one that has ended, nothing: another one is begun. */
export function sessionChoices({ state, held, steered }: Watched): SessionChoices {
  const active = state === 'running' || state === 'paused';
  if (!active) return { pause: null, startAgain: false };
  const mayPause = state === 'running' && !steered;
  return { pause: held ? 'resume' : mayPause ? 'pause' : null, startAgain: true };
}
