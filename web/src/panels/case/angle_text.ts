import { caseText } from '../../text/case_text';
import { fixed } from '../../text/format';

function named(
  degrees: number | null | undefined,
  positive: (text: string) => string,
  negative: (text: string) => string,
  none: string,
): string {
  if (degrees === null || degrees === undefined || !Number.isFinite(degrees)) return caseText.unknown;
  const text = fixed(Math.abs(degrees), 1);
  return text === '0.0' ? none : degrees > 0 ? positive(text) : negative(text);
}

/** Version in words, never by a bare sign; retroversion is negative. */
export const versionText = (degrees: number | null | undefined): string =>
  named(degrees, caseText.anteversion, caseText.retroversion, caseText.noVersion);

/** Inclination in words; superior is positive. */
export const inclinationText = (degrees: number | null | undefined): string =>
  named(degrees, caseText.superior, caseText.inferior, caseText.noInclination);
