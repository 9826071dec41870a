import { levels } from '../practice/level';
import type { Session } from '../wire/rest_types';
import type { Permissions } from './permissions';
import type { Practice } from './practice';
import { beginPractice, type PracticeChoice } from './practice_choice';
import type { Watcher } from './watcher';

/** The next one of its study; the same again; or practice on the same case. */
export type NextSession = 'attempt' | 'again' | 'practise';

interface Person {
  may: Pick<Permissions, 'ream' | 'teach' | 'takePart'>;
  /** The session that this page steered last. */
  steeredLast: string | null;
}

/** Whether the session is of a study, and the next one there is for who uses the page. */
export function goesOnInStudy(session: Session | null, { may, steeredLast }: Person): boolean {
  if (session === null || session.study === null || session.participant === null) return false;
  // Staff who only watched somebody train do not go on in that person's place.
  return may.takePart && (!may.teach || steeredLast === session.id) && session.state !== 'created';
}

/** What comes after a session that has ended; null: nothing that this person may do. */
export function nextSession(session: Session, person: Person): NextSession | null {
  if (!person.may.ream) return null;
  if (goesOnInStudy(session, person)) return 'attempt';
  const { name } = session.device;
  // A haptic device stands beside the page; a demo, and what another page steered, was nobody's try here.
  const own = name === 'browser' ? person.steeredLast === session.id : name !== 'script';
  return own && session.study === null ? 'again' : 'practise';
}

interface Means {
  watcher: Pick<Watcher, 'practise' | 'repeat' | 'train'>;
  practice: Pick<Practice, 'steer' | 'levelOf'>;
  choice: Pick<PracticeChoice, 'caseId' | 'level' | 'choose'>;
  may: Pick<Permissions, 'teach'>;
}

/** Begins it, and takes the reamer into the hand where a browser steers. Problems go to the store. */
export async function beginNext(next: NextSession, session: Session, means: Means): Promise<void> {
  const { watcher, practice, may } = means;
  if (next === 'attempt') {
    const { study, participant } = session;
    const made = await watcher.train(study ?? '', may.teach ? participant : null, session.case);
    if (made?.device.name === 'browser') practice.steer(made.id);
  } else if (next === 'practise') {
    await beginPractice(means, session.case);
  } else if (session.device.name !== 'browser') {
    await watcher.repeat(session.id);
  } else {
    const level = practice.levelOf(session);
    const id = await watcher.practise(session.case, levels[level].theatre);
    if (id !== null) practice.steer(id, level);
  }
}
