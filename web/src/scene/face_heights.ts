import type { ToolMesh } from '../wire/messages';

/** How far the reamer's face reaches into the bone at even distances from its axis, 0 to reachMm; mm, tool frame. */
export interface FaceHeights {
  reachMm: number;
  heightsMm: Float32Array;
}

/** Of the envelope, which is a surface of revolution: the foremost of its edges at each distance from the axis. */
export function faceHeights(tool: ToolMesh, count: number): FaceHeights {
  const { positionsMm, indices } = tool;
  const offAxis = new Float32Array(positionsMm.length / 3);
  let reachMm = 0;
  for (let i = 0; i < offAxis.length; ++i) {
    offAxis[i] = Math.hypot(positionsMm[3 * i] ?? 0, positionsMm[3 * i + 1] ?? 0);
    reachMm = Math.max(reachMm, offAxis[i] ?? 0);
  }
  const heightsMm = new Float32Array(count).fill(-Infinity);
  const raise = (place: number, height: number) => {
    if (height > (heightsMm[place] ?? Infinity)) heightsMm[place] = height;
  };
  const alongEdge = (a: number, b: number) => {
    const [near, far] = (offAxis[a] ?? 0) <= (offAxis[b] ?? 0) ? [a, b] : [b, a];
    const [from, to] = [offAxis[near] ?? 0, offAxis[far] ?? 0];
    const [height, farHeight] = [positionsMm[3 * near + 2] ?? 0, positionsMm[3 * far + 2] ?? 0];
    const step = reachMm / (count - 1);
    for (let place = Math.ceil(from / step - 1e-6); place <= to / step + 1e-6 && place < count; ++place) {
      const share = to > from ? Math.min(Math.max((place * step - from) / (to - from), 0), 1) : 0;
      raise(place, height + (farHeight - height) * share);
    }
  };
  for (let i = 0; i + 2 < indices.length; i += 3) {
    const [a, b, c] = [indices[i] ?? 0, indices[i + 1] ?? 0, indices[i + 2] ?? 0];
    alongEdge(a, b);
    alongEdge(b, c);
    alongEdge(c, a);
  }
  return { reachMm, heightsMm };
}
