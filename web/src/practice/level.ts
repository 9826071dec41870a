import type { Session } from '../wire/rest_types';

/** How much somebody is given while practising, from all of it to nothing. */
export const levelNames = ['guided', 'free', 'own', 'exam'] as const;
export type LevelName = (typeof levelNames)[number];

export interface Between {
  least: number;
  most: number;
}

export interface Level {
  /** How far from the plan the reamer starts, by chance; null: on the plan, to which the hand may return. */
  startsOff: { placeMm: Between; tiltDeg: Between } | null;
  /** The force grows as long as a push lasts; no maximum is chosen before. */
  ownPressure: boolean;
  /** The page says what to do next, what to stop, and that the planned depth is reached. */
  hints: boolean;
  /** Nothing but the picture is shown, as a surgeon sees it. */
  theatre: boolean;
}

export const levels: Readonly<Record<LevelName, Level>> = {
  guided: { startsOff: null, ownPressure: false, hints: true, theatre: false },
  free: { startsOff: off(2, 5, 3, 6), ownPressure: false, hints: true, theatre: false },
  own: { startsOff: off(3, 6, 4, 8), ownPressure: true, hints: false, theatre: false },
  exam: { startsOff: off(4, 8, 5, 10), ownPressure: true, hints: false, theatre: true },
};

function off(leastMm: number, mostMm: number, leastDeg: number, mostDeg: number): Level['startsOff'] {
  return { placeMm: { least: leastMm, most: mostMm }, tiltDeg: { least: leastDeg, most: mostDeg } };
}

export const isLevelName = (text: unknown): text is LevelName => levelNames.some((name) => name === text);

/** The level of a session: what it says itself, else what this page remembers of it. */
export function levelOf(session: Pick<Session, 'theatre'> | null, remembered: LevelName | null): LevelName {
  if (session?.theatre === true) return 'exam';
  return remembered === null || levels[remembered].theatre ? 'guided' : remembered;
}
