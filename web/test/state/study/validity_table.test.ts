import { describe, expect, it } from 'vitest';

import { partNames, short, tableOf } from '../../../src/state/study/validity_table';
import type { ValidityReport } from '../../../src/wire/rest_types';

const nothing: ValidityReport = {
  agreement: [],
  checklist: [],
  known_groups: [],
  correlations: [],
  changes: [],
  arm_differences: [],
  benchmarks: [],
  learning: [],
  notes: [],
};

describe('validity table', () => {
  it('shortens numbers without losing which side of 0 they are', () => {
    expect([0, 0.0004, -0.0004, 0.1234, -1.234, 12.34, 1234.5].map(short)).toEqual([
      '0.000',
      '< 0.001',
      '> -0.001',
      '0.123',
      '-1.23',
      '12.3',
      '1235',
    ]);
    expect(short(undefined)).toBe('');
  });

  it('shows values with intervals, and lines without numbers last', () => {
    const values = {
      n_novices: 10,
      mean_novices: 61.2,
      sd_novices: 8,
      auc: 0.91,
      auc_low: 0.78,
      auc_high: 1,
      welch_p: 0.00001,
    };
    const { head, rows } = tableOf(
      {
        ...nothing,
        known_groups: [
          { subject: '', measure: 'passes', values: {}, notes: ['Only 2 experts.'] },
          { subject: '', measure: 'points', values, notes: [] },
        ],
      },
      'known_groups',
    );
    expect(rows.map((row) => row.name)).toEqual(['points', 'passes']);
    const cell = (title: string) => rows[0]?.cells[head.indexOf(title)];
    expect(cell('Novices')).toBe('61.2 ± 8.00 (n 10)');
    expect(cell('Experts')).toBe('');
    expect(cell('AUC')).toBe('0.910 (0.780 to 1.00)');
    expect(cell('p (Welch)')).toBe('< 0.001');
    expect(rows[1]?.notes).toBe('Only 2 experts.');
  });

  it('shows p of changes and of differences between arms for all measures, too', () => {
    const shown = (part: 'changes' | 'arm_differences', values: Record<string, number>) => {
      const line = { subject: 'guided:post', measure: 'points', values, notes: [] };
      const { head, rows } = tableOf({ ...nothing, [part]: [line] }, part);
      expect(new Set(head).size).toBe(head.length);
      return (title: string) => rows[0]?.cells[head.indexOf(title)];
    };
    const change = shown('changes', { paired_p: 0.01, paired_p_holm: 0.04 });
    expect([change('p (paired)'), change('p (paired, Holm)')]).toEqual(['0.010', '0.040']);
    const apart = shown('arm_differences', { welch_p: 0.02, welch_p_holm: 0.06, ancova_p: 0.03, ancova_p_holm: 0.09 });
    expect([apart('p (Welch)'), apart('p (Welch, Holm)')]).toEqual(['0.020', '0.060']);
    expect([apart('p (ANCOVA)'), apart('p (ANCOVA, Holm)')]).toEqual(['0.030', '0.090']);
  });

  it('has columns for every part', () => {
    expect([...partNames].sort()).toEqual(
      Object.keys(nothing)
        .filter((name) => name !== 'notes')
        .sort(),
    );
    for (const part of partNames) expect(tableOf(nothing, part).rows).toEqual([]);
  });
});
