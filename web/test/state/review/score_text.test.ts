import { describe, expect, it } from 'vitest';

import { bandText, breachText, groupedMetrics, number, valueText } from '../../../src/state/review/score_text';
import { sessionErrorOf } from '../../../src/state/review/session_error';
import type { ScoredMetric } from '../../../src/wire/rest_types';

const metric = (changes: Partial<ScoredMetric>): ScoredMetric => ({
  metric: 'some_mm',
  name: 'Some',
  value: 1,
  missing: null,
  unsaid: null,
  unit: 'mm',
  definition: '',
  source: '',
  evidence: 'S',
  confidence: '',
  band: { better: 'report only' },
  verdict: null,
  points: null,
  weight: null,
  critical: false,
  ...changes,
});

describe('words of a score', () => {
  it('writes values with their units, and a dash for what could not be said', () => {
    expect(valueText({ value: 4.2, unit: 'deg' })).toBe('4.20°');
    expect(valueText({ value: -2.001797, unit: 'deg' })).toBe('−2.00°');
    expect(valueText({ value: 531.67, unit: 'mm3' })).toBe('532 mm³');
    expect(valueText({ value: 2, unit: null })).toBe('2.00');
    expect(valueText({ value: null, unit: 'mm' })).toBe('–');
    expect([0, 0.002175, 0.0951, 1.5, 62.7087].map(number)).toEqual(['0', '0.002', '0.10', '1.50', '62.7']);
  });

  it('says limits in words, each kind and unit', () => {
    expect(bandText({ better: 'less', pass: 5, warn: 10 }, 'deg')).toBe(
      'good up to 5°, borderline up to 10°, bad above',
    );
    expect(bandText({ better: 'less', pass: 104, warn: 104 }, 'N')).toBe('good up to 104 N, bad above');
    expect(bandText({ better: 'more', pass: 80, warn: 60 }, '%')).toContain('good from 80 % on, borderline from 60 %');
    expect(bandText({ better: 'between', low: 35, pass: 70 }, 'N')).toContain('from 35 N to 70 N');
    expect(bandText({ better: 'report only' }, 'mm')).not.toContain('mm');
  });

  it('puts what decides first, then what weighs most, and lists what could not be said', () => {
    const { counting, measured, missing } = groupedMetrics({
      metrics: [
        metric({ metric: 'a', weight: 1 }),
        metric({ metric: 'b', weight: 3 }),
        metric({ metric: 'c', weight: 0.5, critical: true }),
        metric({ metric: 'd', weight: 2, value: null, missing: 'no plan' }),
        metric({ metric: 'e' }),
        metric({ metric: 'f', value: null, missing: 'no contact' }),
      ],
    });
    expect(counting.map((each) => each.metric)).toEqual(['c', 'b', 'd', 'a']);
    expect(measured.map((each) => each.metric)).toEqual(['e']);
    expect(missing.map((each) => each.metric)).toEqual(['d', 'f']);
  });

  it('says of the vault whether it is breached, and why it cannot', () => {
    const vault = (changes: Partial<ScoredMetric>) => ({
      metrics: [metric({ metric: 'vault_breach_mm', ...changes })],
    });
    expect(breachText(vault({ value: 0 })).breached).toBe(false);
    expect(breachText(vault({ value: 1.234 }))).toMatchObject({ breached: true });
    expect(breachText(vault({ value: 1.234 })).message).toContain('1.23 mm');
    expect(breachText(vault({ value: null, missing: 'no implant can be seated' }))).toMatchObject({ breached: null });
    expect(breachText(vault({ value: null, missing: 'no implant can be seated' })).message).toContain('no implant');
    expect(breachText(null).breached).toBeNull();
  });

  it('says of every refusal what can be done', () => {
    const kinds = [404, 409, 422, 403, 0, 500].map((status) => sessionErrorOf({ status, message: 'said so.' }));
    expect(new Set(kinds.map(({ kind }) => kind)).size).toBe(kinds.length);
    for (const { title, text } of kinds) expect(title.length * text.length).toBeGreaterThan(0);
    expect(kinds[2]?.text).toContain('said so.');
  });
});
