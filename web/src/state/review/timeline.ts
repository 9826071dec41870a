import type { Mark } from '../../wire/rest_types';
import type { SessionTrace } from './session_trace';

/** Pressed from so much thrust on, and let go below so much, N: what trembles around one of them is one press. */
const pressedFromN = 3;
const letGoBelowN = 1;
/** 1.5 times the 52 N of the cadaver experiments, as the live page's alarm has it. */
export const excessN = 78;
/** Another moment of the same kind within this time is the same event, s. */
const sameEventS = 0.5;

/** Events found in the forces of a session; times are as fine as the trace. */
export function eventsOfTrace({ timesS, thrustN, spindleOn }: SessionTrace): Mark[] {
  const events: Mark[] = [];
  const lastOf = new Map<string, number>();
  const addEvent = (kind: string, atS: number, detail = '') => {
    const before = lastOf.get(kind);
    lastOf.set(kind, atS);
    if (before === undefined || atS - before >= sameEventS) events.push({ at_s: atS, kind, words: detail });
  };
  let pressed = false;
  let excess = false;
  timesS.forEach((atS, i) => {
    const thrust = thrustN[i] ?? 0;
    const turning = spindleOn[i] ?? false;
    if (turning !== (spindleOn[i - 1] ?? false)) addEvent(turning ? 'spindle-on' : 'spindle-off', atS);
    if (!pressed && thrust >= pressedFromN) addEvent('contact', atS);
    if (pressed && thrust < letGoBelowN) addEvent('withdrawn', atS);
    pressed = pressed ? thrust >= letGoBelowN : thrust >= pressedFromN;
    if (!excess && thrust > excessN) addEvent('excess', atS, thrust.toFixed(0));
    excess = thrust > excessN;
  });
  return events;
}

/** The recording's own marks and those found in the forces, in order of time. */
export function mergedMarks(recorded: readonly Mark[], detected: readonly Mark[]): Mark[] {
  return [...recorded, ...detected].sort((a, b) => a.at_s - b.at_s);
}

/** The next mark after a moment, or the one before; null: there is none. At a mark, that mark is neither. */
export function neighbouringMark(marks: readonly Mark[], positionS: number, forwards: boolean): Mark | null {
  const slackS = 0.02;
  const inOrder = forwards ? marks : [...marks].reverse();
  return inOrder.find(({ at_s }) => (forwards ? at_s > positionS + slackS : at_s < positionS - slackS)) ?? null;
}

/** A moment's share of a session, 0 to 1. */
export function shareOf(positionS: number, durationS: number): number {
  return durationS > 0 ? Math.min(Math.max(positionS / durationS, 0), 1) : 0;
}

/** The moment under a share of the timeline, s, to whole ticks. */
export function momentAt(share: number, durationS: number): number {
  return Math.round(Math.min(Math.max(share, 0), 1) * durationS * 1000) / 1000;
}

/** Whether a moment is the end: the bone is as the session left it. */
export function isEnd(positionTicks: number, durationTicks: number): boolean {
  return durationTicks > 0 && positionTicks >= durationTicks - 1;
}

/** The thrust over a session as points of a picture, pixels from its upper left corner. */
export function thrustLine(
  { timesS, thrustN }: SessionTrace,
  durationS: number,
  width: number,
  height: number,
  mostN: number,
): { x: number; y: number }[] {
  return timesS.map((timeS, i) => ({
    x: shareOf(timeS, durationS) * width,
    y: height - (Math.min(Math.max(thrustN[i] ?? 0, 0), mostN) / mostN) * height,
  }));
}
