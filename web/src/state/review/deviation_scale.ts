import type { DeviationCode, MapName } from '../../wire/review_api';

export type ScaleName = 'fine' | 'report' | 'coarse';
/** Ends of the classes on either side of what is as it should be, mm; the report has the middle ones. */
export const scaleBoundsMm: Record<ScaleName, readonly [number, number, number]> = {
  fine: [0.1, 0.2, 0.4],
  report: [0.25, 0.5, 1],
  coarse: [0.5, 1, 2],
};

/** What a map is painted by: deviations by the scale that is chosen, thickness of the wall by its own. */
export type MapScale = ScaleName | 'wall';
export const scaleOf = (map: MapName, chosen: ScaleName): MapScale => (map === 'wall' ? 'wall' : chosen);

export type Side = 'proud' | 'even' | 'beyond' | 'wall';

/** Deviations that look the same: more than `fromMm` up to `toMm`. */
export interface DeviationClass {
  fromMm: number;
  toMm: number;
  side: Side;
  /** Red, green, blue, 0 to 255. */
  colour: readonly [number, number, number];
  /** So that too deep is told apart without colour. */
  hatched: boolean;
}

/**
 * ColorBrewer's PuOr, the colours of the report: orange where bone stands proud over white to purple where too much is
 * gone. They stay apart in all kinds of colour blindness.
 */
const proudColours = [
  [179, 88, 6],
  [241, 163, 64],
  [254, 224, 182],
] as const;
const evenColour = [247, 247, 247] as const;
const beyondColours = [
  [216, 218, 235],
  [153, 142, 195],
  [84, 39, 136],
] as const;
/** The report's colours of a wall, ColorBrewer's YlGnBu: the thinner the darker. Ends of the classes, mm. */
const wallColours = [
  [8, 29, 88],
  [34, 94, 168],
  [65, 182, 196],
  [161, 218, 180],
  [255, 255, 204],
] as const;
const wallBoundsMm = [2, 5, 10, 15];
/** Bone with nothing to compare. */
export const unknownColour = [189, 183, 172] as const;

/** From what stands proudest to what is cut deepest; of a wall from the thinnest, which is hatched. */
export function deviationClasses(scale: MapScale): DeviationClass[] {
  if (scale === 'wall') return wallClasses();
  const [a, b, c] = scaleBoundsMm[scale];
  const ends = [-Infinity, -c, -b, -a, a, b, c, Infinity];
  const colours = [...proudColours, evenColour, ...beyondColours];
  return colours.map((colour, i) => ({
    fromMm: ends[i] ?? -Infinity,
    toMm: ends[i + 1] ?? Infinity,
    side: i < 3 ? 'proud' : i === 3 ? 'even' : 'beyond',
    colour,
    hatched: i > 3,
  }));
}

function wallClasses(): DeviationClass[] {
  const ends = [-Infinity, ...wallBoundsMm, Infinity];
  return wallColours.map((colour, i) => ({
    fromMm: ends[i] ?? -Infinity,
    toMm: ends[i + 1] ?? Infinity,
    side: 'wall',
    colour,
    hatched: i === 0,
  }));
}

/** mm of a byte; null: nothing to compare. */
export function deviationMm(byte: number, { stepMm, unknown }: DeviationCode): number | null {
  return byte === unknown ? null : byte * stepMm;
}

export function classOf(mm: number, classes: readonly DeviationClass[]): DeviationClass {
  const found = classes.find(({ toMm }) => mm <= toMm) ?? classes.at(-1);
  if (found === undefined) throw new RangeError('a scale has classes');
  return found;
}

/** RGBA of all bytes, at byte + 128; the last of the four is 255 where it is hatched, 0 where it is not. */
export function paletteOf(scale: MapScale, code: DeviationCode): Uint8Array<ArrayBuffer> {
  const classes = deviationClasses(scale);
  const palette = new Uint8Array(256 * 4);
  for (let byte = -128; byte < 128; ++byte) {
    const mm = deviationMm(byte, code);
    const { colour, hatched } = mm === null ? { colour: unknownColour, hatched: false } : classOf(mm, classes);
    palette.set([...colour, hatched ? 255 : 0], (byte + 128) * 4);
  }
  return palette;
}

/** Of a map, which shares of what can be compared lie in each class, 0 to 1, and how much can be compared at all. */
export interface DeviationShares {
  classes: number[];
  known: number;
  /** Vertices whose deviation is only known to be out of range. */
  beyondRange: number;
}

export function deviationShares(bytes: Int8Array, scale: MapScale, code: DeviationCode): DeviationShares {
  const counts = new Uint32Array(256);
  for (const byte of bytes) counts[byte + 128] = (counts[byte + 128] ?? 0) + 1;
  const classes = deviationClasses(scale);
  const sums = classes.map(() => 0);
  let known = 0;
  for (let byte = -128; byte < 128; ++byte) {
    const count = counts[byte + 128] ?? 0;
    const mm = deviationMm(byte, code);
    if (mm === null || count === 0) continue;
    const at = classes.indexOf(classOf(mm, classes));
    sums[at] = (sums[at] ?? 0) + count;
    known += count;
  }
  const beyondRange = (counts[127 + 128] ?? 0) + (counts[-127 + 128] ?? 0);
  return { classes: sums.map((sum) => (known === 0 ? 0 : sum / known)), known, beyondRange };
}
