import type { ToolMesh } from '../../src/wire/messages';

type Point = [offMm: number, zMm: number];

/** An outline turned around z in 96 sides, as server/shell/tool.cpp does it. */
export function revolved(outline: readonly Point[], sides = 96): ToolMesh {
  const positions: number[] = [];
  const indices: number[] = [];
  const first: number[] = [];
  for (const [offMm, zMm] of outline) {
    first.push(positions.length / 3);
    for (let side = 0; side < (offMm > 0 ? sides : 1); ++side) {
      const angle = (2 * Math.PI * side) / sides;
      positions.push(offMm * Math.cos(angle), offMm * Math.sin(angle), zMm);
    }
  }
  const at = (i: number, side: number) => (first[i] ?? 0) + ((outline[i]?.[0] ?? 0) > 0 ? side % sides : 0);
  for (let i = 0; i + 1 < outline.length; ++i)
    for (let side = 0; side < sides; ++side) {
      const [a, b, c, d] = [at(i, side), at(i + 1, side), at(i + 1, side + 1), at(i, side + 1)];
      if (b !== c) indices.push(a, b, c);
      if (a !== d) indices.push(a, c, d);
    }
  return { name: 'revolved', positionsMm: Float32Array.from(positions), indices: Uint32Array.from(indices) };
}

interface Words {
  acrossMm: number;
  alongMm: number;
  rimMm: number;
  nipple?: [radiusMm: number, heightMm: number];
  backMm?: number;
}

/** As server/shell/parametric_profile.cpp makes it of a reamer's words. */
export function outlineOf({ acrossMm, alongMm, rimMm, nipple, backMm = 4 }: Words): Point[] {
  const capZ = (offMm: number) => -alongMm * (1 - Math.sqrt(Math.max(0, 1 - (offMm / acrossMm) ** 2)));
  const [foot, tip] = nipple ?? [0, 0];
  const outline: Point[] =
    nipple === undefined
      ? [[0, 0]]
      : [
          [0, tip],
          [foot, tip],
          [foot, capZ(foot)],
        ];
  const [begin, end] = [Math.asin(foot / acrossMm), Math.asin(rimMm / acrossMm)];
  for (let i = 1; i <= 12; ++i) {
    const offMm = i === 12 ? rimMm : acrossMm * Math.sin(begin + ((end - begin) * i) / 12);
    outline.push([offMm, capZ(offMm)]);
  }
  const back = capZ(rimMm) - backMm;
  outline.push([rimMm, back], [4, back], [4, back - 5], [0, back - 5]);
  return outline;
}

const sphere = (radiusMm: number, rimMm: number, nipple?: [number, number]) =>
  outlineOf({ acrossMm: radiusMm, alongMm: radiusMm, rimMm, ...(nipple === undefined ? {} : { nipple }) });

/** Reamers of the library that differ most, as server/shell/reamer_library.cpp has them. */
export const libraryOutlines: Record<string, Point[]> = {
  thesis: outlineOf({ acrossMm: 16, alongMm: 8, rimMm: 16, nipple: [3, 8], backMm: 1.25 }),
  'thesis-appendix-a': outlineOf({ acrossMm: 18.25, alongMm: 9, rimMm: 18.25 }),
  'convex-30': sphere(30, 14, [3, 8]),
  'convex-60': sphere(60, 19, [3, 8]),
  'cannulated-40': sphere(40, 16),
  'flat-30': sphere(1000, 15, [3, 8]),
  'baseplate-27': sphere(60, 13.5),
};
