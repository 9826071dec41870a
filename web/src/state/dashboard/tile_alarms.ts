import type { Session, Metrics } from '../../wire/rest_types';
import { farPastMm, pastPlanMm } from '../alarms';

/** A share of missed ticks above this is worth saying, percent. */
const lateAbovePercent = 0.1;

export interface TileAlarm {
  kind: 'fault' | 'vault' | 'depth' | 'thrust' | 'late';
  level: 'warn' | 'bad';
  /** mm or percent; null where there is no figure. */
  value: number | null;
  /** The server's words, of a fault. */
  message: string | null;
}

/** One session as it was last read, and as it was read before. */
export interface Reading {
  session: Session;
  soFar: Metrics | null;
  before: Metrics | null;
  plannedDepthMm: number | null;
}

/** What is wrong in a session that is under way, worst first. Thrust is reported only while it is too high. */
export function alarmsOf({ session, soFar, before, plannedDepthMm }: Reading): TileAlarm[] {
  const found: TileAlarm[] = [];
  const add = (
    kind: TileAlarm['kind'],
    level: TileAlarm['level'],
    value: number | null,
    message: string | null = null,
  ) => found.push({ kind, level, value, message });
  if (session.fault !== null && session.fault !== '') add('fault', 'bad', null, session.fault);
  const breachMm = soFar?.vault_breach_mm ?? 0;
  if (breachMm > 0) add('vault', 'bad', breachMm);
  const pastMm = pastPlanMm(soFar?.reaming_depth_mm ?? NaN, plannedDepthMm ?? 0);
  if (pastMm !== null) add('depth', pastMm > farPastMm ? 'bad' : 'warn', pastMm);
  const grown = (soFar?.axial_thrust_excess_n_s ?? 0) - (before?.axial_thrust_excess_n_s ?? Infinity);
  if (grown > 0) add('thrust', 'bad', null);
  const missed = session.loop.missed;
  const percent = session.tick === 0 ? 0 : (missed / session.tick) * 100;
  if (percent > lateAbovePercent) add('late', 'warn', percent);
  return found.sort((a, b) => Number(b.level === 'bad') - Number(a.level === 'bad'));
}
