import { reviewText } from '../../text/review_text';
import type { Band, Score, ScoredMetric } from '../../wire/rest_types';
import { fixed } from '../../text/format';

/** A metric's unit as people write it; empty for a bare number. */
export function unitOf(unit: string | null): string {
  if (unit === null) return '';
  return reviewText.units[unit] ?? unit;
}

/** The same as a word. */
export const unitName = (unit: string): string => reviewText.unitNames[unit] ?? unit;

/** Enough decimals to tell values apart, and no more than are meant. */
export function number(value: number): string {
  const size = Math.abs(value);
  const decimals = size >= 100 ? 0 : size >= 10 ? 1 : size >= 0.095 ? 2 : size === 0 ? 0 : 3;
  return fixed(value, decimals);
}

/** A value with its unit; a dash where it could not be said. */
export function valueText({ value, unit }: Pick<ScoredMetric, 'value' | 'unit'>): string {
  return value === null ? fixed(null, 0) : withUnit(number(value), unit);
}

/** A number that is a text already, with its unit. */
export function withUnit(text: string, unit: string | null): string {
  const shown = unitOf(unit);
  return shown === '' ? text : shown === '°' ? `${text}°` : `${text} ${shown}`;
}

/** What is good and what is bad, with the unit. */
export function bandText(band: Band, unit: string | null): string {
  // A limit is written as it was set.
  const limit = (value: number) => withUnit(String(Number(value.toPrecision(6))).replace('-', '−'), unit);
  switch (band.better) {
    case 'report only':
      return reviewText.bandReport;
    case 'less':
      return reviewText.bandLess(limit(band.pass), limit(band.warn));
    case 'more':
      return reviewText.bandMore(limit(band.pass), limit(band.warn));
    case 'between':
      return reviewText.bandBetween(limit(band.low), limit(band.pass));
  }
}

export interface MetricGroups {
  /** That the rubric asks for, weightiest first; also those that could not be said. */
  counting: ScoredMetric[];
  measured: ScoredMetric[];
  missing: ScoredMetric[];
}

/** Metrics as a reader wants them: first what the mark rests on. */
export function groupedMetrics({ metrics }: Pick<Score, 'metrics'>): MetricGroups {
  const counting = metrics.filter(({ weight }) => weight !== null);
  counting.sort((a, b) => Number(b.critical) - Number(a.critical) || (b.weight ?? 0) - (a.weight ?? 0));
  const rest = metrics.filter(({ weight }) => weight === null);
  return {
    counting,
    measured: rest.filter(({ value }) => value !== null),
    missing: metrics.filter(({ value }) => value === null),
  };
}

/** What the score says of the vault, in words. */
export function breachText(score: Pick<Score, 'metrics'> | null): { breached: boolean | null; message: string } {
  const metric = score?.metrics.find(({ metric }) => metric === 'vault_breach_mm');
  const value = metric?.value ?? null;
  if (metric === undefined || value === null)
    return { breached: null, message: reviewText.breachMissing(metric?.missing ?? reviewText.scoreLoading) };
  if (value <= 0) return { breached: false, message: reviewText.breachNone };
  return { breached: true, message: reviewText.breachBy(number(value)) };
}
