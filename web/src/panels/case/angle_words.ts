import { caseWords } from '../../case_words';
import { fixed } from '../format';

function named(
  degrees: number | null | undefined,
  positive: (text: string) => string,
  negative: (text: string) => string,
  none: string,
): string {
  if (degrees === null || degrees === undefined || !Number.isFinite(degrees)) return caseWords.unknown;
  const text = fixed(Math.abs(degrees), 1);
  return text === '0.0' ? none : degrees > 0 ? positive(text) : negative(text);
}

/** Version in words, never by a bare sign; retroversion is negative. */
export const versionWords = (degrees: number | null | undefined): string =>
  named(degrees, caseWords.anteversion, caseWords.retroversion, caseWords.noVersion);

/** Inclination in words; superior is positive. */
export const inclinationWords = (degrees: number | null | undefined): string =>
  named(degrees, caseWords.superior, caseWords.inferior, caseWords.noInclination);
