import { validityText } from '../../text/validity_text';
import type { ValidityReport } from '../../wire/rest_types';

export type PartName = Exclude<keyof ValidityReport, 'notes'>;
type Line = ValidityReport[PartName][number];
type Values = Readonly<Record<string, number>>;
type Column = readonly [title: string, cell: (values: Values) => string];

const { columns: titles } = validityText;

/** Three significant digits; empty for what is missing. */
export function short(value: number | undefined): string {
  if (value === undefined) return '';
  if (value !== 0 && Math.abs(value) < 0.001) return value < 0 ? '> -0.001' : '< 0.001';
  const digits = Math.abs(value) >= 100 ? 0 : Math.abs(value) >= 10 ? 1 : Math.abs(value) >= 1 ? 2 : 3;
  return value.toFixed(digits);
}

const plain = (name: string) => (values: Values) => short(values[name]);

/** With its interval, where there is one. */
const ranged = (name: string) => (values: Values) => {
  const [low, high] = [values[`${name}_low`], values[`${name}_high`]];
  const value = short(values[name]);
  return low === undefined || high === undefined ? value : validityText.interval(value, short(low), short(high));
};

const group = (name: string) => (values: Values) => {
  const n = values[`n_${name}`];
  const mean = values[`mean_${name}`];
  return mean === undefined ? '' : validityText.group(short(mean), short(values[`sd_${name}`]), String(n ?? 0));
};

const count = (name: string) => (values: Values) => String(values[name] ?? '');

const columns: Record<PartName, readonly Column[]> = {
  agreement: [
    [titles.sessions, count('subjects')],
    [titles.iccSingle, ranged('icc_single')],
    [titles.iccAverage, ranged('icc_average')],
  ],
  checklist: [
    [titles.sessions, count('subjects')],
    [titles.kappa, ranged('kappa')],
    [titles.agreement, plain('agreement')],
  ],
  known_groups: [
    [titles.novices, group('novices')],
    [titles.experts, group('experts')],
    [titles.g, ranged('hedges_g')],
    [titles.auc, ranged('auc')],
    [titles.p, plain('welch_p')],
    [titles.holm, plain('welch_p_holm')],
  ],
  correlations: [
    [titles.n, count('n')],
    [titles.pearson, ranged('pearson')],
    [titles.spearman, plain('spearman')],
    [titles.pearsonP, plain('pearson_p')],
    [titles.pearsonHolm, plain('pearson_p_holm')],
  ],
  changes: [
    [titles.n, count('n')],
    [titles.change, ranged('change')],
    [titles.pairedP, plain('paired_p')],
    [titles.pairedHolm, plain('paired_p_holm')],
  ],
  arm_differences: [
    [titles.difference, ranged('difference')],
    [titles.p, plain('welch_p')],
    [titles.holm, plain('welch_p_holm')],
    [titles.ancova, ranged('ancova')],
    [titles.ancovaP, plain('ancova_p')],
    [titles.ancovaHolm, plain('ancova_p_holm')],
  ],
  benchmarks: [
    [titles.n, count('n')],
    [titles.mean, ranged('mean')],
    [titles.median, ranged('median')],
  ],
  learning: [
    [titles.attempts, count('attempts')],
    [titles.start, ranged('start')],
    [titles.plateau, ranged('plateau')],
    [titles.rate, ranged('rate')],
  ],
};

export const partNames = Object.keys(columns) as PartName[];

export interface ValidityTable {
  head: readonly string[];
  rows: readonly { name: string; about: string; cells: readonly string[]; notes: string }[];
}

/** One part of the report as words; lines that have but remarks come last. */
export function tableOf(report: ValidityReport, part: PartName): ValidityTable {
  const shown = columns[part];
  const rows = report[part].map((line: Line) => ({
    name: line.measure,
    about: line.subject,
    cells: shown.map(([, cell]) => cell(line.values)),
    notes: line.notes.join(' '),
  }));
  const said = (row: { cells: readonly string[]; notes: string }) => (row.notes === '' ? 0 : 1);
  return { head: shown.map(([title]) => title), rows: rows.sort((a, b) => said(a) - said(b)) };
}
