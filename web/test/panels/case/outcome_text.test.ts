import { describe, expect, it } from 'vitest';

import { outcomeRows, outcomeWarning } from '../../../src/panels/case/outcome_text';
import type { PlanOutcome } from '../../../src/wire/rest_types';

const reached: PlanOutcome = {
  footprint_area_mm2: 500,
  depth_mean_mm: 0.8248,
  medialization_mm: 1.94,
  seating_percent: 92.6,
  plate_preserved_percent: 88.2,
  joint_line_mm: 2.06,
  vault_distance_component_mm: 3.21,
  parts_through_vault: 0,
};
const of = (part: Partial<PlanOutcome>) => ({ ...reached, ...part });

describe('the outcome of a plan', () => {
  it('has a unit for each figure, and words for a side', () => {
    expect(outcomeRows(reached).map(([, value]) => value)).toEqual([
      '93 %',
      '88 %',
      '412 mm³',
      '1.9 mm',
      '2.1 mm lateral',
      '3.2 mm',
    ]);
    expect(outcomeRows(of({ joint_line_mm: -1.5 })).flat()).toContain('1.5 mm medial');
    expect(outcomeRows(of({ joint_line_mm: -0.04 })).flat()).toContain('as the native one');
    expect(outcomeRows(of({ vault_distance_component_mm: -1.2 })).flat()).toContain('1.2 mm outside the bone');
    expect(outcomeWarning(reached)).toBeNull();
  });

  it('says what is wrong first', () => {
    const nothing = Object.fromEntries(Object.keys(reached).map((key) => [key, null])) as unknown as PlanOutcome;
    expect(outcomeRows(nothing)).toEqual([]);
    expect(outcomeWarning(nothing)).toContain('does not touch');
    expect(outcomeWarning(of({ seating_percent: null }))).toContain('No bone');
    expect(outcomeWarning(of({ parts_through_vault: 1 }))).toContain('A peg or keel');
    expect(outcomeWarning(of({ parts_through_vault: 3 }))).toMatch(/^3 pegs/);
  });
});
