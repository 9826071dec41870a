import { reviewWords } from '../../review_words';
import type { Band, Score, ScoredMetric } from '../../wire/score_types';
import { fixed } from '../../panels/format';

/** A metric's unit as people write it; empty for a bare number. */
export function unitOf(unit: string | null): string {
  if (unit === null) return '';
  return reviewWords.units[unit] ?? unit;
}

/** The same as a word. */
export const unitName = (unit: string): string => reviewWords.unitNames[unit] ?? unit;

/** Enough decimals to tell values apart, and no more than are meant. */
export function number(value: number): string {
  const size = Math.abs(value);
  const decimals = size >= 100 ? 0 : size >= 10 ? 1 : size >= 0.095 ? 2 : size === 0 ? 0 : 3;
  return fixed(value, decimals);
}

/** A value with its unit; a dash where it could not be said. */
export function valueWords({ value, unit }: Pick<ScoredMetric, 'value' | 'unit'>): string {
  return value === null ? fixed(null, 0) : withUnit(number(value), unit);
}

function withUnit(text: string, unit: string | null): string {
  const shown = unitOf(unit);
  return shown === '' ? text : shown === '°' ? `${text}°` : `${text} ${shown}`;
}

/** What is good and what is bad, with the unit. */
export function bandWords(band: Band, unit: string | null): string {
  // A limit is written as it was set.
  const limit = (value: number) => withUnit(String(Number(value.toPrecision(6))).replace('-', '−'), unit);
  switch (band.better) {
    case 'report only':
      return reviewWords.bandReport;
    case 'less':
      return reviewWords.bandLess(limit(band.pass), limit(band.warn));
    case 'more':
      return reviewWords.bandMore(limit(band.pass), limit(band.warn));
    case 'between':
      return reviewWords.bandBetween(limit(band.low), limit(band.pass));
  }
}

export interface MetricGroups {
  /** That the rubric asks for, weightiest first; also those that could not be said. */
  counting: ScoredMetric[];
  measured: ScoredMetric[];
  unsaid: ScoredMetric[];
}

/** Metrics as a reader wants them: first what the mark rests on. */
export function groupedMetrics({ metrics }: Pick<Score, 'metrics'>): MetricGroups {
  const counting = metrics.filter(({ weight }) => weight !== null);
  counting.sort((a, b) => Number(b.critical) - Number(a.critical) || (b.weight ?? 0) - (a.weight ?? 0));
  const rest = metrics.filter(({ weight }) => weight === null);
  return {
    counting,
    measured: rest.filter(({ value }) => value !== null),
    unsaid: metrics.filter(({ value }) => value === null),
  };
}

/** What the score says of the vault, in words. */
export function breachWords(score: Pick<Score, 'metrics'> | null): { breached: boolean | null; words: string } {
  const metric = score?.metrics.find(({ metric }) => metric === 'vault_breach_mm');
  const value = metric?.value ?? null;
  if (metric === undefined || value === null)
    return { breached: null, words: reviewWords.breachUnsaid(metric?.unsaid ?? reviewWords.scoreLoading) };
  if (value <= 0) return { breached: false, words: reviewWords.breachNone };
  return { breached: true, words: reviewWords.breachBy(number(value)) };
}
