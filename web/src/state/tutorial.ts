import { excessThrustN } from './alarms';

/**
 * The first reaming, step by step. A step is done by the state that it asks for, never by time; this file knows nothing
 * of the page, only what holds at a moment.
 */

/** The score gives all points for a mean thrust within these, N (proto/rubrics/standard.json). */
export const thrustBandN = { from: 35, to: 70 } as const;
/** Up to this much is a touch, N. */
export const touchMostN = 25;
/** Words do not come and go at the rim of what is too hard: they end this far below it, N. */
const clearlyLessN = 5;
/** The plan counts as reached within this, mm. */
export const depthWithinMm = 0.3;
/** The orange dot is in the green ring. */
export const aimWithin = { mm: 1.5, deg: 5 } as const;
/** Only beyond this it has left the ring, so that words do not come and go at its rim. */
const aimLost = { mm: 2, deg: 7 } as const;
const turnedEnoughDeg = 15;
const zoomedEnough = 1.08;
const turnedBackDeg = 3;
/** Thrust of a reamer that nobody presses, N. */
const restingN = 6;
/** So far above its pocket the reamer is free, mm. */
const freeMm = 2;

/** What holds at a moment. */
export interface TutorialSnapshot {
  /** This page has the reamer in its hand. */
  steering: boolean;
  /** The session has ended. */
  ended: boolean;
  /** And not because somebody ended it. */
  failed: boolean;
  /** The input in use can zoom; others look from the set views. */
  canZoom: boolean;
  /** How far the picture is turned from how the tutorial began, and was at most. */
  turnedDeg: number;
  mostTurnedDeg: number;
  /** How many times nearer or farther the picture has been at most. */
  zoomed: number;
  /** Of reamer and aim, whichever is farther from the planned axis. */
  besideMm: number;
  leanDeg: number;
  /** The drive is switched on. */
  spindleOn: boolean;
  spindleTurns: boolean;
  /** The drive cannot turn the reamer against the bone. */
  stalled: boolean;
  irrigating: boolean;
  /** The reamer touches bone. */
  touching: boolean;
  /** What the person asks for; negative: withdraw. */
  pushN: number;
  thrustN: number;
  depthMm: number;
  plannedMm: number;
  /** How far the reamer is drawn back from the deepest place where it was. */
  drawnBackMm: number;
}

export const stepNames = ['look', 'aim', 'spindle', 'touch', 'press', 'stop', 'withdraw', 'result'] as const;
export type StepName = (typeof stepNames)[number];

/** How somebody has left the path. */
export type Astray =
  | 'tooDeep'
  | 'endedEarly'
  | 'notInHand'
  | 'tooEarly'
  | 'stalled'
  | 'spindleOff'
  | 'offAxis'
  | 'tooHard'
  | 'tooShallow'
  | 'pressesOn';

interface Step {
  done: (now: TutorialSnapshot) => boolean;
  /** What may be said of somebody at this step, the most important first. */
  watches: readonly Astray[];
}

const within = (value: number, { from, to }: { from: number; to: number }) => value >= from && value <= to;
const onAxis = (now: TutorialSnapshot) => now.besideMm <= aimWithin.mm && now.leanDeg <= aimWithin.deg;
const deepEnough = (now: TutorialSnapshot) => now.depthMm >= now.plannedMm - depthWithinMm;

export const steps: Readonly<Record<StepName, Step>> = {
  look: {
    done: (now) =>
      now.mostTurnedDeg >= turnedEnoughDeg &&
      (now.canZoom ? now.zoomed >= zoomedEnough : now.turnedDeg <= turnedBackDeg),
    watches: ['tooEarly'],
  },
  aim: { done: (now) => onAxis(now) && !now.touching, watches: ['tooEarly'] },
  spindle: { done: (now) => now.spindleTurns && now.irrigating, watches: ['tooEarly'] },
  touch: {
    done: (now) => now.touching && now.spindleTurns && now.pushN > 0 && now.thrustN <= touchMostN && onAxis(now),
    watches: ['stalled', 'spindleOff', 'offAxis', 'tooHard'],
  },
  press: {
    // Who reams gently to the plan is not made to press there.
    done: (now) =>
      deepEnough(now) ||
      (now.touching &&
        now.spindleTurns &&
        within(now.thrustN, thrustBandN) &&
        onAxis(now) &&
        now.depthMm >= now.plannedMm / 4),
    watches: ['stalled', 'spindleOff', 'offAxis', 'tooHard'],
  },
  stop: {
    done: (now) => deepEnough(now) && now.pushN <= 0 && now.thrustN <= restingN,
    watches: ['stalled', 'spindleOff', 'offAxis', 'tooHard', 'tooShallow'],
  },
  withdraw: {
    done: (now) => now.spindleTurns && !now.touching && now.drawnBackMm >= now.plannedMm + freeMm,
    watches: ['stalled', 'pressesOn', 'spindleOff'],
  },
  result: { done: (now) => now.ended, watches: ['pressesOn'] },
};

const tooHardN = (step: StepName) => (step === 'touch' ? touchMostN : excessThrustN);
const offAxis = (now: TutorialSnapshot) => now.besideMm > aimLost.mm || now.leanDeg > aimLost.deg;

/** What begins to hold. */
const holds: Readonly<Record<Astray, (now: TutorialSnapshot, step: StepName) => boolean>> = {
  tooDeep: (now) => now.plannedMm > 0 && now.depthMm > now.plannedMm + depthWithinMm,
  endedEarly: (now, step) => now.ended && (step !== 'result' || now.failed),
  notInHand: (now) => !now.ended && !now.steering,
  tooEarly: (now) => now.touching && now.pushN > 0,
  stalled: (now) => now.stalled,
  spindleOff: (now) => !now.spindleOn,
  offAxis: (now) => now.touching && now.pushN > 0 && offAxis(now),
  tooHard: (now, step) => now.touching && now.thrustN > tooHardN(step),
  tooShallow: (now) => now.pushN <= 0 && !deepEnough(now),
  pressesOn: (now) => now.pushN > 0 && now.touching,
};

/**
 * What goes on to hold once it has been said, where that is more: a reamer that bounces on the bone, or a hand that
 * trembles, changes no words.
 */
const stillHolds: Partial<typeof holds> = {
  tooEarly: (now) => now.pushN > 0,
  offAxis: (now) => now.pushN > 0 && !onAxis(now),
  tooHard: (now, step) => now.thrustN > tooHardN(step) - clearlyLessN,
  tooShallow: (now) => now.pushN <= restingN && !deepEnough(now),
  pressesOn: (now) => now.pushN > 0,
};

/** Whatever the step. */
const always: readonly Astray[] = ['tooDeep', 'endedEarly', 'notInHand'];

/** From the step that is under way to the one that is next to be done; `stepNames.length`: all are. */
export function advanced(step: number, now: TutorialSnapshot): number {
  const name = stepNames[step];
  if (name === undefined || astray(step, now, always) !== null) return step;
  return steps[name].done(now) ? step + 1 : step;
}

/** How somebody at a step has left the path, after what was said of that before; null: not at all. */
export function strayed(step: number, now: TutorialSnapshot, said: Astray | null = null): Astray | null {
  const name = stepNames[step];
  if (name === undefined) return null;
  return astray(step, now, [...always, ...steps[name].watches], said);
}

function astray(
  step: number,
  now: TutorialSnapshot,
  among: readonly Astray[],
  said: Astray | null = null,
): Astray | null {
  const name = stepNames[step];
  if (name === undefined) return null;
  return among.find((one) => holds[one](now, name) || (one === said && stillHolds[one]?.(now, name))) ?? null;
}
