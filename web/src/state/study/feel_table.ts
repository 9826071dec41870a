import { fixed } from '../../text/format';
import { feelText } from '../../text/feel_text';
import type { FeelReport } from '../../wire/rest_types';
import { short } from './validity_table';

type Line = FeelReport['lines'][number];

/** One question of the report as words; empty for what is missing. */
export interface FeelRow {
  comparison: Line['comparison'];
  question: string;
  participants: string;
  right: string;
  sd: string;
  p: string;
  dPrime: string;
  published: { share: string; source: string } | null;
  note: string;
}

const inPercent = (share: number) => fixed(share * 100, 0);

export function feelRow(line: Line): FeelRow {
  const { published } = line;
  return {
    comparison: line.comparison,
    question: line.question,
    participants: String(line.persons),
    right: rightText(line),
    sd: line.sd === null ? '' : feelText.percent(inPercent(line.sd)),
    p: short(line.chance_p_holm ?? undefined),
    dPrime: line.d_prime === null ? '' : fixed(line.d_prime, 2),
    published: published && {
      share: feelText.published(inPercent(published.share), inPercent(published.sd)),
      source: published.source,
    },
    note: line.note,
  };
}

function rightText({ right, low, high }: Line): string {
  if (right === null) return '';
  if (low === null || high === null) return feelText.percent(inPercent(right));
  return feelText.interval(inPercent(right), inPercent(low), inPercent(high));
}
