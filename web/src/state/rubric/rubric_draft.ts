import { computed, signal } from '@preact/signals';

import type { KeptRubric, KnownMetric, Rubric } from '../../wire/rest_types';
import type { PlacedFault } from '../../wire/rest';
import { blankCriterion, type CriterionDraft, criterionDraft, criterionOf, numberIn } from './criterion_draft';
import { type Faults, faultsIn, faultsOf, type RubricHead } from './rubric_faults';

interface Content extends RubricHead {
  remark: string;
  criteria: readonly CriterionDraft[];
}

/** A rubric while it is edited. */
export class RubricDraft {
  readonly content = signal<Content>(blank);
  /** The version that is edited. */
  readonly version = signal(1);
  private readonly saved = signal('');
  /** What the server refused, until the next change. */
  private readonly refused = signal<Faults>(new Map());
  private nextKey = 0;

  readonly changed = computed(() => said(this.content.value) !== this.saved.value);
  readonly faults = computed<Faults>(
    () => new Map([...this.refused.value, ...faultsOf(this.content.value, this.content.value.criteria, this.metrics)]),
  );
  /** As the server takes it; null as long as it would not. */
  readonly rubric = computed<Rubric | null>(() =>
    faultsOf(this.content.value, this.content.value.criteria, this.metrics).size > 0
      ? null
      : rubricOf(this.content.value, this.version.value),
  );
  /** Metrics that it does not ask for yet. */
  readonly unused = computed(() => {
    const used = new Set(this.content.value.criteria.map(({ metric }) => metric));
    return this.metrics.filter(({ metric }) => !used.has(metric));
  });

  constructor(
    kept: KeptRubric,
    readonly metrics: readonly KnownMetric[],
  ) {
    this.take(kept);
  }

  /** From now on this is what is saved; what was typed since `sent` was the content stays. */
  take({ version, rubric }: KeptRubric, sent: Content = this.content.peek()): void {
    const kept: Content = {
      name: rubric.name,
      remark: rubric.remark ?? '',
      passPoints: rubric.pass_points === undefined ? '' : String(rubric.pass_points),
      leastMeasured: String(rubric.least_said_percent ?? 50),
      criteria: rubric.criteria.map((criterion) => criterionDraft(this.nextKey++, criterion)),
    };
    this.version.value = version;
    this.saved.value = said(kept);
    if (this.content.peek() === sent) this.content.value = kept;
    this.refused.value = new Map();
  }

  set(change: Partial<Content>): void {
    this.content.value = { ...this.content.value, ...change };
    this.refused.value = new Map();
  }
  change(key: number, change: Partial<CriterionDraft>): void {
    this.set({ criteria: this.content.value.criteria.map((one) => (one.key === key ? { ...one, ...change } : one)) });
  }
  /** Gives the key of the new line. */
  add(metric: string): number {
    const added = blankCriterion(this.nextKey++, metric);
    const unlimited = this.metrics.find((known) => known.metric === metric)?.band.better === 'report only';
    const line = unlimited ? { ...added, points: 'curve' as const, curve: twoPoints } : added;
    this.set({ criteria: [...this.content.value.criteria, line] });
    return added.key;
  }
  remove(key: number): void {
    this.set({ criteria: this.content.value.criteria.filter((one) => one.key !== key) });
  }
  refuse(errors: readonly PlacedFault[]): void {
    this.refused.value = faultsIn(errors);
  }
}

export const twoPoints = [
  { at: '', points: '100' },
  { at: '', points: '0' },
];

const blank: Content = { name: '', remark: '', passPoints: '', leastMeasured: '50', criteria: [] };

/** Without what only the page knows. */
const said = (content: Content): string =>
  JSON.stringify(content, (name, value: unknown) => (name === 'key' ? undefined : value));

function rubricOf(content: Content, version: number): Rubric {
  const { name, remark, passPoints, leastMeasured, criteria } = content;
  return {
    name: name.trim(),
    version,
    ...(remark.trim() === '' ? {} : { remark: remark.trim() }),
    ...(passPoints.trim() === '' ? {} : { pass_points: numberIn(passPoints) }),
    least_said_percent: numberIn(leastMeasured),
    criteria: criteria.map(criterionOf),
  };
}

/** "House rubric" is house-rubric, or house-rubric-2 where that is taken. */
export function rubricId(name: string, taken: readonly string[]): string {
  const plain = name
    .toLowerCase()
    .replace(/[^a-z0-9]+/g, '-')
    .replace(/^-+|-+$/g, '')
    .slice(0, 55);
  const id = plain === '' ? 'rubric' : plain;
  for (let number = 1; ; ++number) {
    const numbered = number === 1 ? id : `${id}-${number}`;
    if (!taken.includes(numbered)) return numbered;
  }
}
