import { rubricText } from '../../text/rubric_text';
import type { KnownMetric } from '../../wire/rest_types';
import type { PlacedFault } from '../../wire/rest';
import { type CriterionDraft, numberIn } from './criterion_draft';

/** What is wrong by place: "name", "criteria/2/weight". */
export type Faults = ReadonlyMap<string, string>;
type Note = (field: string, words: string) => void;

export interface RubricHead {
  name: string;
  passPoints: string;
  leastMeasured: string;
}

/** What the server would refuse, said before it is asked. */
export function faultsOf(
  head: RubricHead,
  criteria: readonly CriterionDraft[],
  metrics: readonly KnownMetric[],
): Faults {
  const faults = new Map<string, string>();
  const note: Note = (place, words) => {
    if (!faults.has(place)) faults.set(place, words);
  };
  if (head.name.trim() === '') note('name', rubricText.needed);
  if (head.passPoints.trim() !== '') within(head.passPoints, 0, 100, (words) => note('pass_points', words));
  within(head.leastMeasured, 0, 100, (words) => note('least_said_percent', words));
  if (criteria.length === 0) note('criteria', rubricText.noMetrics);
  const seen = new Set<string>();
  criteria.forEach((criterion, i) => {
    const at: Note = (field, words) => note(`criteria/${i}/${field}`, words);
    if (seen.has(criterion.metric)) at('metric', rubricText.twice);
    seen.add(criterion.metric);
    checkCriterion(criterion, metrics.find(({ metric }) => metric === criterion.metric) ?? null, at);
  });
  return faults;
}

/** The same of what the server refused after all. */
export function faultsIn(errors: readonly PlacedFault[]): Faults {
  return new Map(errors.map(({ pointer, detail }) => [pointer.replace(/^#\//, ''), detail]));
}

function within(typed: string, low: number, high: number, note: (words: string) => void): void {
  const value = numberIn(typed);
  if (!(value >= low && value <= high)) note(rubricText.between(String(low), String(high)));
}

function checkCriterion(draft: CriterionDraft, known: KnownMetric | null, note: Note): void {
  within(draft.weight, 0, 1_000_000, (words) => note('weight', words));
  const unlimited = draft.limits === 'catalogue' && known?.band.better === 'report only';
  if (unlimited && draft.critical) note('critical', rubricText.criticalNeedsLimits);
  if (draft.points === 'curve') checkCurve(draft, note);
  else if (unlimited) note('points', rubricText.needsCurve);
  if (draft.limits !== 'catalogue') checkLimits(draft, note);
}

function checkCurve({ curve }: CriterionDraft, note: Note): void {
  if (curve.length < 2) note('curve', rubricText.twoPoints);
  curve.forEach(({ at, points }, i) => {
    if (!Number.isFinite(numberIn(at))) note(`curve/${i}/at`, rubricText.needed);
    else if (i > 0 && numberIn(at) <= numberIn(curve[i - 1]?.at ?? '')) note(`curve/${i}/at`, rubricText.ascending);
    within(points, 0, 100, (words) => note(`curve/${i}/points`, words));
  });
}

function checkLimits({ limits, pass, warn, low }: CriterionDraft, note: Note): void {
  const second = limits === 'between' ? 'low' : 'warn';
  const [first, other] = [numberIn(pass), numberIn(second === 'low' ? low : warn)];
  if (!Number.isFinite(first)) note('band/pass', rubricText.needed);
  if (!Number.isFinite(other)) note(`band/${second}`, rubricText.needed);
  const ordered = limits === 'between' ? other < first : limits === 'less' ? first <= other : first >= other;
  if (Number.isFinite(first) && Number.isFinite(other) && !ordered)
    note(`band/${second}`, rubricText.limitsOrder[limits === 'catalogue' ? 'less' : limits]);
}
