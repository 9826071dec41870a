import { describe, expect, it } from 'vitest';

import { feelRow } from '../../../src/state/study/feel_table';
import type { FeelReport } from '../../../src/wire/rest_types';

const line: FeelReport['lines'][number] = {
  ...{ comparison: 'bone_under_cartilage', question: 'On which plate?', persons: 9, answers: 72, right: 0.774 },
  ...{ sd: 0.23, low: 0.597, high: 0.951, chance_p: 0.0002, chance_p_holm: 0.0004, d_prime: 1.0634, note: '' },
  published: { share: 0.77, sd: 0.23, source: 'Strelzow 2023' },
};

describe('row of the report of feel', () => {
  it('shows shares in percent, with interval and beside what is published', () => {
    expect(feelRow(line)).toEqual({
      comparison: 'bone_under_cartilage',
      question: 'On which plate?',
      participants: '9',
      right: '77 % (60 to 95 %)',
      sd: '23 %',
      p: '< 0.001',
      dPrime: '1.06',
      published: { share: '77 % (SD 23 %)', source: 'Strelzow 2023' },
      note: '',
    });
  });

  it('leaves out what is missing, not what is nothing', () => {
    const alone = {
      persons: 1,
      right: 0,
      sd: null,
      low: null,
      high: null,
      chance_p: null,
      chance_p_holm: null,
      d_prime: null,
    };
    const note = 'one participant only';
    expect(feelRow({ ...line, ...alone, published: null, note })).toMatchObject({
      ...{ participants: '1', right: '0 %', sd: '', p: '', dPrime: '', published: null, note },
    });
    expect(feelRow({ ...line, ...alone, persons: 0, right: null }).right).toBe('');
    expect(feelRow({ ...line, d_prime: -0.5 }).dPrime).toBe('−0.50');
  });
});
