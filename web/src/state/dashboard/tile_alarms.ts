import type { Session, Metrics } from '../../wire/rest_types';
import { farPastMm, pastPlanMm } from '../alarms';
import { type HealthState, isLate, missedPercent } from '../health';

export interface TileAlarm {
  kind: 'fault' | 'vault' | 'depth' | 'thrust' | Exclude<HealthState, 'ok'>;
  level: 'warn' | 'bad';
  /** mm; null where there is no figure. */
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
  const { fault } = session;
  // Of a device that is lost the server's words say no more than that.
  if (session.device.state === 'lost') add('lost', 'bad', null, fault);
  else if (fault !== null && fault !== '') add('fault', 'bad', null, fault);
  const breachMm = soFar?.vault_breach_mm ?? 0;
  if (breachMm > 0) add('vault', 'bad', breachMm);
  const pastMm = pastPlanMm(soFar?.reaming_depth_mm ?? NaN, plannedDepthMm ?? 0);
  if (pastMm !== null) add('depth', pastMm > farPastMm ? 'bad' : 'warn', pastMm);
  const grown = (soFar?.axial_thrust_excess_n_s ?? 0) - (before?.axial_thrust_excess_n_s ?? Infinity);
  if (grown > 0) add('thrust', 'bad', null);
  if (isLate(missedPercent(session.loop.missed, session.tick))) add('slow', 'warn', null);
  return found.sort((a, b) => Number(b.level === 'bad') - Number(a.level === 'bad'));
}
