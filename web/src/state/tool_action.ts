import { standingSpindleRadS, type Telemetry } from '../wire/telemetry';

/** What is seen to move at the reamer. */
export interface ToolAction {
  /** As fast as the picture goes on; below zero backwards, 0: it stands. */
  spindleRadS: number;
  irrigating: boolean;
  /** Since the session began. */
  removedMm3: number;
  tick: number;
}

/** Null: nothing moves, for the session or its replay rests or has ended, or what is shown is not of this moment. */
export function toolAction(telemetry: Telemetry | null, upToDate: boolean): ToolAction | null {
  if (telemetry === null || !upToDate) return null;
  const { playback, state, irrigating, removedVolumeMm3, tick } = telemetry;
  if (playback === null ? state !== 'running' : !playback.playing) return null;
  const spindleRadS = telemetry.spindleSpeedRadS * (playback?.speed ?? 1);
  const turns = Math.abs(telemetry.spindleSpeedRadS) > standingSpindleRadS;
  return { spindleRadS: turns ? spindleRadS : 0, irrigating, removedMm3: removedVolumeMm3, tick };
}
