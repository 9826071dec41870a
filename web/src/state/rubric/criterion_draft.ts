import type { Criterion, Limits } from '../../wire/rest_types';

/** Whose limits decide: the catalogue's, or the rubric's own of one kind. */
export type LimitsChoice = 'catalogue' | Limits['better'];
/** Where the points of a metric come from. */
export type PointsChoice = 'limits' | 'curve';

/** A point of a curve as it is typed. */
export interface CurveDraft {
  at: string;
  points: string;
}

/** One line of a rubric as it is being filled in; numbers as they are typed. */
export interface CriterionDraft {
  /** Tells it from others of its rubric as long as that is open. */
  key: number;
  metric: string;
  weight: string;
  critical: boolean;
  points: PointsChoice;
  curve: readonly CurveDraft[];
  limits: LimitsChoice;
  pass: string;
  warn: string;
  low: string;
  source: string;
}

export const maxCurvePoints = 50;
const text = (value: number | undefined) => (value === undefined ? '' : String(value));
export const numberIn = (typed: string): number => (typed.trim() === '' ? NaN : Number(typed));

export const blankCriterion = (key: number, metric: string): CriterionDraft => ({
  ...{ key, metric, weight: '1', critical: false, points: 'limits', curve: [] },
  ...{ limits: 'catalogue', pass: '', warn: '', low: '', source: '' },
});

export function criterionDraft(key: number, criterion: Criterion): CriterionDraft {
  const { metric, band, weight = 1, critical = false, source = '' } = criterion;
  const curve = curveOf(criterion);
  return {
    ...{ key, metric, weight: text(weight), critical, source },
    points: curve.length > 0 ? 'curve' : 'limits',
    curve: curve.map(({ at, points }) => ({ at: text(at), points: text(points) })),
    limits: band?.better ?? 'catalogue',
    ...{ pass: text(band?.pass), warn: text(band?.warn), low: text(band?.low) },
  };
}

/** A line from `none` to `full` is a curve of two points. */
function curveOf({ curve, none, full }: Criterion): { at: number; points: number }[] {
  if (curve !== undefined) return curve;
  if (none === undefined || full === undefined) return [];
  const [zero, hundred] = [
    { at: none, points: 0 },
    { at: full, points: 100 },
  ];
  return none < full ? [zero, hundred] : [hundred, zero];
}

/** As the server takes it; only of a draft without faults. */
export function criterionOf(draft: CriterionDraft): Criterion {
  const curve = draft.curve.map(({ at, points }) => ({ at: numberIn(at), points: numberIn(points) }));
  return {
    metric: draft.metric,
    weight: numberIn(draft.weight),
    ...(draft.critical ? { critical: true } : {}),
    ...(draft.points === 'curve' ? { curve } : {}),
    ...(draft.limits === 'catalogue' ? {} : { band: limitsOf(draft, draft.limits) }),
    ...(draft.source.trim() === '' ? {} : { source: draft.source.trim() }),
  };
}

function limitsOf({ pass, warn, low }: CriterionDraft, better: Limits['better']): Limits {
  const second = better === 'between' ? { low: numberIn(low) } : { warn: numberIn(warn) };
  return { better, pass: numberIn(pass), ...second };
}
