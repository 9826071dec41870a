import type { Playback as WirePlayback } from './generated/ream/wire/playback';
import { SessionState as WireState } from './generated/ream/wire/session-state';
import type { Telemetry as WireTelemetry } from './generated/ream/wire/telemetry';
import { pose, type Pose } from './pose';

/** Speed of a drive whose trigger is pressed all the way, and that below which its spindle stands, rad/s. */
export const fullSpindleRadS = (156 * 2 * Math.PI) / 60;
export const standingSpindleRadS = 0.02 * fullSpindleRadS;

export type SessionState =
  'created' | 'running' | 'paused' | 'finished' | 'stopped' | 'fault' | 'interrupted' | 'replaying';

/** Where a replay stands; times are those of the recording. */
export interface Playback {
  positionTicks: number;
  speed: number;
  playing: boolean;
  /** Grows with every jump: a trace of another jump does not belong to this one. */
  jump: number;
}

/** A batch of the force trace (entry i is of tick firstTick + i * tickStride) and the newest state. */
export interface Telemetry {
  firstTick: number;
  tickStride: number;
  thrustN: Float32Array<ArrayBuffer>;
  feedRatesMmS: Float32Array<ArrayBuffer>;
  /** Acceleration of the reamer beside what contact does. Empty where the server does not send it. */
  vibrationG: Float32Array<ArrayBuffer>;
  /** The newest tick of all, and what held then. */
  tick: number;
  handForceN: number;
  torqueNMm: number;
  feedRateMmS: number;
  densityGCc: number;
  worldFromTool: Pose | null;
  worldFromHandle: Pose | null;
  spindleOn: boolean;
  /** Reversed negative. */
  spindleSpeedRadS: number;
  /** The drive cannot turn the reamer against the bone. */
  stalled: boolean;
  irrigating: boolean;
  /** Of the bone under the reamer; null where it is not simulated. */
  surfaceTemperatureC: number | null;
  state: SessionState;
  depthMm: number;
  removedVolumeMm3: number;
  corticalShare: number;
  dropped: number;
  tickMeanUs: number;
  tickP99Us: number;
  ticksMissed: number;
  fault: string;
  /** How far the bone has moved from where the hello has it; null while it is held rigidly. */
  worldFromBoneRest: Pose | null;
  /** Null for what is live. */
  playback: Playback | null;
  /** When it was on its way, by the server's own clock, ms; 0: not sent. */
  stampMs: number;
  /** When it came, ms since 1970 by this computer's clock; absent where nobody has looked at the clock. */
  receivedMs?: number;
}

export function decodeTelemetry(t: WireTelemetry): Telemetry {
  return {
    firstTick: t.firstTick(),
    tickStride: Math.max(t.tickStride(), 1),
    thrustN: Float32Array.from(t.thrustNArray() ?? []),
    feedRatesMmS: Float32Array.from(t.feedRateMmSArray() ?? []),
    vibrationG: Float32Array.from(t.vibrationGArray() ?? []),
    tick: t.tick(),
    handForceN: last(t.handForceNArray()),
    torqueNMm: last(t.torqueNMmArray()),
    feedRateMmS: last(t.feedRateMmSArray()),
    densityGCc: last(t.densityGCcArray()),
    worldFromTool: pose(t.worldFromTool()),
    worldFromHandle: pose(t.worldFromHandle()),
    spindleOn: t.spindleOn(),
    spindleSpeedRadS: t.spindleSpeedRadS(),
    stalled: t.stalled(),
    irrigating: t.irrigating(),
    surfaceTemperatureC: t.surfaceTemperatureC() || null,
    state: sessionState(t.state()),
    depthMm: t.depthMm(),
    removedVolumeMm3: t.removedVolumeMm3(),
    corticalShare: t.corticalShare(),
    dropped: t.dropped(),
    tickMeanUs: t.tickMeanUs(),
    tickP99Us: t.tickP99Us(),
    ticksMissed: t.ticksMissed(),
    fault: t.fault() ?? '',
    worldFromBoneRest: pose(t.worldFromBoneRest()),
    playback: decodePlayback(t.playback()),
    stampMs: Number(t.stampUs()) / 1000,
  };
}

function decodePlayback(p: WirePlayback | null): Playback | null {
  if (p === null) return null;
  return { positionTicks: p.positionTicks(), speed: p.speed(), playing: p.playing(), jump: p.jump() };
}

function sessionState(state: WireState): SessionState {
  switch (state) {
    case WireState.created:
      return 'created';
    case WireState.running:
      return 'running';
    case WireState.paused:
      return 'paused';
    case WireState.finished:
      return 'finished';
    case WireState.stopped:
      return 'stopped';
    case WireState.fault:
      return 'fault';
    case WireState.interrupted:
      return 'interrupted';
    case WireState.replaying:
      return 'replaying';
    default:
      throw new Error(`unknown session state ${String(state)}`);
  }
}

function last(values: Float32Array | null): number {
  return values?.at(-1) ?? 0;
}
