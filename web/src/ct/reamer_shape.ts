import type { Reamer } from '../wire/rest_types';

/** Half the outline of a reamer's cutting surface: distance from the axis and behind the apex, mm, apex first. */
export type Outline = readonly { offAxisMm: number; behindMm: number }[];

const steps = 24;

/** A cap of the reamer's radius over its diameter; flat where no sphere fits. */
export function reamerOutline(reamer: Pick<Reamer, 'diameter_mm' | 'radius_mm'> | undefined): Outline {
  const rim = (reamer?.diameter_mm ?? 36) / 2;
  const radius = reamer?.radius_mm ?? 0;
  return Array.from({ length: steps + 1 }, (_, i) => {
    const offAxisMm = (rim * i) / steps;
    const behindMm = radius < rim ? 0 : radius - Math.sqrt(radius * radius - offAxisMm * offAxisMm);
    return { offAxisMm, behindMm };
  });
}
