import { isHeldBySomebody } from './curve';
import type { Session } from '../../wire/rest_types';
import type { Learner } from '../../wire/dashboard_api';

/** Somebody who has trained, as far as the user may know. */
export interface KnownLearner extends Learner {
  /** Tells them apart. */
  key: string;
  /** For people. */
  name: string;
  /** How many of the sessions that were looked through are theirs. */
  sessions: number;
}

/** Who trained in these sessions, newest first: by name, or by the code of a study where the name is not to be known. */
export function learnersIn(sessions: readonly Session[]): KnownLearner[] {
  const found = new Map<string, KnownLearner>();
  for (const session of sessions.filter(isHeldBySomebody)) {
    const learner = learnerOf(session);
    if (learner === null) continue;
    const known = found.get(learner.key);
    if (known === undefined) found.set(learner.key, learner);
    else ++known.sessions;
  }
  return [...found.values()];
}

function learnerOf({ trainee_id: trainee, trainee: name, participant }: Session): KnownLearner | null {
  if (trainee) return { key: `trainee ${trainee}`, trainee, name: name || trainee, sessions: 1 };
  if (participant) return { key: `participant ${participant}`, participant, name: participant, sessions: 1 };
  return null;
}
