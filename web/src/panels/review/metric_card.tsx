import { useLayoutEffect, useRef } from 'preact/hooks';

import { reviewText } from '../../text/review_text';
import { bandText, number, unitName, valueText } from '../../state/review/score_text';
import type { Score } from '../../wire/rest_types';
import { sentence } from '../../text/format';

/** The metric that is pointed at or focused, and where its row is in the window. */
export interface Pointed {
  metric: string;
  beside: DOMRect;
}

const gapPx = 10;

/** What stands behind a metric: definition, unit, limits, source, confidence. */
export function MetricCard({ pointed, scores }: { pointed: Pointed; scores: readonly (Score | null)[] }) {
  const card = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    const element = card.current;
    if (element !== null) place(element, pointed.beside);
  }, [pointed]);
  const found = scores.map((score) => score?.metrics.find(({ metric }) => metric === pointed.metric) ?? null);
  const metric = found.find((one) => one !== null);
  if (metric === undefined || metric === null) return null;
  const missing = found.find((one) => one?.missing)?.missing ?? null;
  const rows: [string, string][] = [
    [reviewText.definition, sentence(metric.definition)],
    [reviewText.unit, metric.unit === null ? reviewText.noUnit : unitName(metric.unit)],
    [reviewText.band, sentence(bandText(metric.band, metric.unit))],
    [reviewText.source, sentence(metric.source)],
    [reviewText.confidence, sentence(`${reviewText.evidence[metric.evidence]}: ${metric.confidence}`)],
  ];
  if (metric.weight !== null)
    rows.push([
      reviewText.weight,
      reviewText.weightOf(number(metric.weight), metric.points === null ? '–' : number(metric.points)),
    ]);
  if (missing !== null) rows.push([reviewText.missingReason, sentence(missing)]);
  return (
    <div class="metric-card" id="metric-card" role="tooltip" ref={card} data-testid="metric-card">
      <p class="metric-title">
        {metric.name}: {found.map((one) => (one === null ? '–' : valueText(one))).join(' / ')}
      </p>
      <dl>
        {rows.map(([name, text]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{text}</dd>
          </div>
        ))}
      </dl>
    </div>
  );
}

/** Left of its row where there is room, else below or above it. */
function place(card: HTMLElement, beside: DOMRect): void {
  const { offsetWidth: width, offsetHeight: height } = card;
  const left = beside.left - width - gapPx;
  const fits = left >= gapPx;
  const top = fits
    ? beside.top
    : beside.bottom + height + gapPx > innerHeight
      ? beside.top - height - 4
      : beside.bottom + 4;
  card.style.left = `${Math.max(fits ? left : Math.min(beside.left, innerWidth - width - gapPx), gapPx)}px`;
  card.style.top = `${Math.max(Math.min(top, innerHeight - height - gapPx), gapPx)}px`;
}
