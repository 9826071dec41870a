import { caseText } from '../../text/case_text';
import { fixed } from '../../text/format';
import type { Reamer } from '../../wire/rest_types';

/** From this radius on a reamer is flat for whoever chooses one, mm. */
const flatFromMm = 500;

/** A reamer of the library by its name and what it measures. */
export function reamerText({ name, diameter_mm, radius_mm }: Reamer): string {
  const diameter = fixed(diameter_mm, 1);
  return radius_mm === null || radius_mm >= flatFromMm
    ? caseText.reamerFlat(name, diameter)
    : caseText.reamerText(name, diameter, fixed(radius_mm, 1));
}

/** A plan's reamer, which it may describe by its form; one that is not in the library stays as the plan says it. */
export function plannedReamerText(planned: string, library: readonly Reamer[]): string {
  const known = library.find(({ name, words }) => name === planned || words === planned);
  return known === undefined ? planned : reamerText(known);
}
