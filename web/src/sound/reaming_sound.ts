import { fullSpindleRadS, standingSpindleRadS } from '../wire/telemetry';

/** What of a session is heard. Of this moment, or nothing. */
export interface SoundInput {
  spindleOn: boolean;
  /** Simulated, N. */
  thrustN: number;
  feedRateMmS: number;
  /** Of what is engaged, 0 without contact, g/cc. */
  densityGCc: number;
  /** Of what is engaged, 0 to 1. */
  corticalShare: number;
  /** Reversed negative, rad/s; null where a recording does not say it. */
  spindleSpeedRadS: number | null;
  stalled: boolean;
  /** Strength that the hand feels, g rms; null where it is not known: then the value published for the bone. */
  vibrationG: number | null;
  /** Whether the vibration itself is heard, so that none has to be made up. */
  tracked: boolean;
}

/** For the synthesizer; gains 0 to 1. */
export interface SoundParameters {
  motorHz: number;
  motorGain: number;
  /** Middle of the band of the cutting noise. */
  cuttingHz: number;
  cuttingGain: number;
  /** Of the vibration as it is sent, a g. */
  trackGain: number;
}

/** To the audio thread: parameters, or the vibration of the next ticks, g. */
export type SoundMessage = SoundParameters | { vibrationG: Float32Array };

export const silence: SoundParameters = { motorHz: 0, motorGain: 0, cuttingHz: 0, cuttingGain: 0, trackGain: 0 };

/** g rms of a reamer in bone: Faieghi's cadaver experiments, as docs/reference.md has them. */
export const corticalGRms = 0.3;
export const cancellousGRms = 0.4;
/** The thrust at which they were measured, N. */
const measuredAtN = 52;

// How a drill sounds is judged by ear, not measured: its hum, how much a push slows it, and the bands of the bone.
const motorHz = 190;
/** A motor that cannot turn still hums. */
const stalledHz = 60;
const motorSlowsBy = 0.18;
const slowestAtN = 104;
const motorGain = 0.16;
const cancellousHz = 620;
const corticalHz = 1900;
const gainPerG = 1.4;
/** Single blows of the track are six times its strength: so that they are not cut off. */
const trackGainPerG = 0.4;
const cuttingGainMost = 0.75;
/** A reamer that rests on the bone without going in rubs more quietly, full cutting from this feed on, mm/s. */
const fullFeedMmS = 0.05;
const rubbingShare = 0.45;

/**
 * The sound of a spinning reamer: a hum as fast as the spindle turns, and the vibration that the hand feels. Where that
 * is not sent, a noise that is brighter in harder bone stands for it.
 */
export function soundOf(input: SoundInput): SoundParameters {
  const speed = speedShare(input);
  if (speed === 0 && !input.stalled) return silence;
  const push = share(input.thrustN / slowestAtN);
  const cortical = share(input.corticalShare);
  const engaged = input.densityGCc > 0 && input.thrustN > 0;
  return {
    motorHz: motorPitchHz(input, speed, push),
    motorGain: motorGain * (1 + 0.5 * push) * (input.stalled ? 1 : share(speed)),
    cuttingHz: cancellousHz * (corticalHz / cancellousHz) ** cortical,
    cuttingGain: engaged && !input.tracked ? Math.min(strengthG(input, cortical) * gainPerG, cuttingGainMost) : 0,
    trackGain: input.tracked ? trackGainPerG : 0,
  };
}

/** Of the full speed; 0 while it stands. */
function speedShare({ spindleOn, spindleSpeedRadS }: SoundInput): number {
  if (spindleSpeedRadS === null) return spindleOn ? 1 : 0;
  const speedRadS = Math.abs(spindleSpeedRadS);
  return speedRadS > standingSpindleRadS ? speedRadS / fullSpindleRadS : 0;
}

function motorPitchHz({ spindleSpeedRadS, stalled }: SoundInput, speed: number, push: number): number {
  if (stalled) return stalledHz;
  if (spindleSpeedRadS === null) return motorHz * (1 - motorSlowsBy * push);
  return Math.min(Math.max(motorHz * speed, stalledHz), 4 * motorHz);
}

/** How strongly it shakes, g rms. */
function strengthG({ vibrationG, thrustN, feedRateMmS }: SoundInput, cortical: number): number {
  if (vibrationG !== null) return Math.abs(vibrationG);
  const published = cancellousGRms + (corticalGRms - cancellousGRms) * cortical;
  const cutting = rubbingShare + (1 - rubbingShare) * share(feedRateMmS / fullFeedMmS);
  return published * share(thrustN / measuredAtN) * cutting;
}

const share = (value: number): number => (Number.isFinite(value) ? Math.min(Math.max(value, 0), 1) : 0);
