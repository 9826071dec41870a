import type { Between, Level } from './level';
import type { Beside } from './plan_frame';

/** Where the reamer starts beside the plan, and how far it leans, mm and degrees. */
export interface StartPose {
  place: Beside;
  lean: Beside;
}

/** Within the level's limits, in any direction; null: on the plan. */
export function startPose({ startsOff }: Pick<Level, 'startsOff'>, random: () => number): StartPose | null {
  if (startsOff === null) return null;
  return { place: somewhere(startsOff.placeMm, random), lean: somewhere(startsOff.tiltDeg, random) };
}

function somewhere({ least, most }: Between, random: () => number): Beside {
  const far = least + (most - least) * random();
  const way = 2 * Math.PI * random();
  return { superior: far * Math.cos(way), anterior: far * Math.sin(way) };
}

/** Numbers from 0 to 1, the same for the same text: a session starts where it did before the page was loaded anew. */
export function randomOf(text: string): () => number {
  // FNV-1a of the text, then mulberry32.
  let state = 0x811c9dc5;
  for (let i = 0; i < text.length; ++i) state = Math.imul(state ^ text.charCodeAt(i), 0x01000193);
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}
