import type { Learning, Outcome, Session } from '../../wire/rest_types';

/** One session of a course of learning. */
export interface CurvePoint {
  session: string;
  created_utc: string;
  outcome: Outcome;
  points: number | null;
  cusum: number | null;
}

/** Older ones are left out of the picture; the table has them all. */
export const drawnAtMost = 60;

export const curveOfLearning = ({ sessions }: Learning): readonly CurvePoint[] => sessions;

/** Demos and scripted runs count for nobody. */
export const isHeldBySomebody = ({ device }: Session): boolean => device.name !== 'script';

/** Of sessions as they are listed, newest first. */
export function curveOfSessions(sessions: readonly Session[]): readonly CurvePoint[] {
  return sessions
    .filter(isHeldBySomebody)
    .reverse()
    .map(({ id, created_utc, score }) => ({
      session: id,
      created_utc,
      outcome: score?.outcome ?? null,
      points: score?.points ?? null,
      cusum: null,
    }));
}

/** Values with room above and below, and nice marks between; `atLeast` is always within. */
export function scaleFor(values: readonly number[], atLeast: readonly number[]): { low: number; high: number } {
  const all = [...values, ...atLeast];
  const low = Math.min(...all);
  const high = Math.max(...all);
  const room = (high - low) * 0.08;
  return { low: low - room, high: high + room };
}
