import { caseText } from '../../text/case_text';
import { fixed } from '../../text/format';
import type { PlanOutcome } from '../../wire/rest_types';

type Value = number | null | undefined;

const shown = (value: Value, decimals: number, unit: string): string =>
  typeof value === 'number' ? caseText.fixed(fixed(value, decimals), unit) : caseText.unknown;

/** Against the native joint line, never by a bare sign. */
function jointLineText(mm: Value): string {
  if (typeof mm !== 'number') return caseText.unknown;
  const text = fixed(Math.abs(mm), 1);
  if (text === '0.0') return caseText.outcomeNative;
  return mm < 0 ? caseText.outcomeMedial(text) : caseText.outcomeLateral(text);
}

function vaultText(mm: Value): string {
  if (typeof mm === 'number' && mm < 0) return caseText.outcomeOutside(fixed(-mm, 1));
  return shown(mm, 1, caseText.mm);
}

/** Name and value of what a plan reaches; nothing where the reamer touches no face. */
export function outcomeRows(outcome: PlanOutcome): [name: string, value: string][] {
  const { footprint_area_mm2: area, depth_mean_mm: depth } = outcome;
  if (area === null || depth === null) return [];
  return [
    [caseText.outcomeSeating, shown(outcome.seating_percent, 0, '%')],
    [caseText.outcomePlate, shown(outcome.plate_preserved_percent, 0, '%')],
    [caseText.outcomeRemoved, shown(area * depth, 0, 'mm³')],
    [caseText.outcomeMedialization, shown(outcome.medialization_mm, 1, caseText.mm)],
    [caseText.outcomeJointLine, jointLineText(outcome.joint_line_mm)],
    [caseText.outcomeVault, vaultText(outcome.vault_distance_component_mm)],
  ];
}

/** Why the plan cannot be what is wanted, the gravest reason first; null: none of these. */
export function outcomeWarning(outcome: PlanOutcome): string | null {
  if (outcome.footprint_area_mm2 === null) return caseText.outcomeNoTouch;
  if (outcome.seating_percent === null) return caseText.outcomeNoSeat;
  const through = outcome.parts_through_vault ?? 0;
  return through > 0 ? caseText.outcomeThrough(through) : null;
}
