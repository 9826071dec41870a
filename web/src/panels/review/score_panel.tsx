import { useSignal } from '@preact/signals';
import { useMemo } from 'preact/hooks';

import type { Pane } from './review_workspace';
import { limits, limitsTitle } from '../../text/limits_text';
import { outcomeText } from '../../text/result_text';
import { reviewText } from '../../text/review_text';
import { groupedMetrics, number, valueText } from '../../state/review/score_text';
import type { Score, ScoredMetric, Verdict } from '../../wire/rest_types';
import { fixed, sentence } from '../../text/format';
import { OutcomeMark } from '../dashboard/outcome_mark';
import { MetricCard, type Pointed } from './metric_card';

/** What the sessions are worth: the mark, and every metric with what stands behind it. */
export function ScorePanel({ panes }: { panes: readonly Pane[] }) {
  const pointed = useSignal<Pointed | null>(null);
  const scores = panes.map(({ session }) => session.score.value.value);
  const first = scores.find((score) => score !== null);
  return (
    <section class="review-panel score-panel" aria-labelledby="score-title" data-testid="score">
      <h2 id="score-title">{reviewText.score}</h2>
      {panes.map(({ session }, i) => (
        <Mark
          key={session.id + String(i)}
          score={scores[i] ?? null}
          problem={session.score.problem.value}
          place={i}
          several={panes.length > 1}
        />
      ))}
      {first !== undefined && <Metrics scores={scores} first={first} pointed={pointed} />}
      <Limits />
      {pointed.value !== null && <MetricCard pointed={pointed.value} scores={scores} />}
    </section>
  );
}

/** The same of one session, where there is no more than its score. */
export function ScoreCard({ score }: { score: Score }) {
  const pointed = useSignal<Pointed | null>(null);
  return (
    <>
      <Mark score={score} problem={null} place={0} several={false} />
      <Metrics scores={[score]} first={score} pointed={pointed} />
      <Limits />
      {pointed.value !== null && <MetricCard pointed={pointed.value} scores={[score]} />}
    </>
  );
}

/** Under the marks: what they do not rest on. */
function Limits() {
  return (
    <details>
      <summary data-testid="limits">{limitsTitle}</summary>
      <ul class="reasons">
        {limits.map((limit) => (
          <li key={limit}>{limit}</li>
        ))}
      </ul>
    </details>
  );
}

interface MarkParts {
  score: Score | null;
  problem: string | null;
  place: number;
  several: boolean;
}

function Mark({ score, problem, place, several }: MarkParts) {
  if (score === null)
    return (
      <p class="soft" role="status" data-testid={`no-score-${place}`}>
        {several && <span class="pane-number">{place + 1}</span>}
        {problem === null ? reviewText.scoreLoading : reviewText.noScore(sentence(problem))}
      </p>
    );
  const { points, outcome, rubric, reasons, advice, theatre, said_percent: measuredPercent } = score;
  return (
    <div class="mark-of" data-testid={`mark-${place}`}>
      <p class="overall">
        {several && <span class="pane-number">{place + 1}</span>}
        <span class="visually-hidden">{reviewText.overall}: </span>
        <strong>{points === null ? reviewText.noPoints : reviewText.points(fixed(points, 1))}</strong>
        <OutcomeMark outcome={outcome} words={outcome === null ? reviewText.noOutcome : outcomeText[outcome]} />
        {theatre && (
          <span class="role-chip" title={reviewText.theatreHint}>
            {reviewText.theatre}
          </span>
        )}
      </p>
      <p class="soft">
        {reviewText.rubric(rubric.rubric.name, rubric.version, rubric.rubric.pass_points)}.{' '}
        {measuredPercent < 100 && reviewText.measuredPercent(fixed(measuredPercent, 0))}
      </p>
      {reasons.length > 0 && (
        <ul class="reasons">
          {reasons.map((reason) => (
            <li key={reason}>{sentence(reason)}</li>
          ))}
        </ul>
      )}
      {advice.length > 0 && (
        <>
          <h3>{reviewText.nextTime}</h3>
          <ol class="advice" data-testid={`advice-${place}`}>
            {advice.map(({ metric, words }) => (
              <li key={metric}>{words}</li>
            ))}
          </ol>
        </>
      )}
    </div>
  );
}

interface MetricsParts {
  scores: readonly (Score | null)[];
  first: Score;
  pointed: { value: Pointed | null };
}

function Metrics({ scores, first, pointed }: MetricsParts) {
  const { counting, measured, missing } = useMemo(() => groupedMetrics(first), [first]);
  const parts = { scores, pointed };
  return (
    <>
      <MetricTable {...parts} title={reviewText.countsForMark} metrics={counting} counting />
      <details>
        <summary data-testid="other-metrics">{reviewText.otherMetrics(measured.length)}</summary>
        <MetricTable {...parts} title={reviewText.otherMetrics(measured.length)} metrics={measured} />
      </details>
      {missing.length > 0 && <MissingMetrics metrics={missing} />}
    </>
  );
}

/** What has no value, and why. */
function MissingMetrics({ metrics }: { metrics: readonly ScoredMetric[] }) {
  return (
    <details>
      <summary data-testid="missing-metrics">{reviewText.missing(metrics.length)}</summary>
      <dl class="missing-list">
        {metrics.map((metric) => (
          <div key={metric.metric}>
            <dt>{metric.name}</dt>
            <dd>{sentence(metric.missing ?? '')}</dd>
          </div>
        ))}
      </dl>
    </details>
  );
}

interface TableParts {
  scores: readonly (Score | null)[];
  pointed: { value: Pointed | null };
  title: string;
  metrics: readonly ScoredMetric[];
  counting?: boolean;
}

function MetricTable({ scores, pointed, title, metrics, counting }: TableParts) {
  const several = scores.length > 1;
  return (
    <table class="metrics">
      <caption class={counting === true ? '' : 'visually-hidden'}>{title}</caption>
      <thead>
        <tr>
          <th scope="col">{reviewText.metricColumn}</th>
          {scores.map((_, i) => (
            <th key={i} scope="col" class="number">
              {several ? <span class="pane-number">{i + 1}</span> : reviewText.valueColumn}
            </th>
          ))}
          {counting === true && !several && (
            <th scope="col" class="number">
              {reviewText.pointsColumn}
            </th>
          )}
        </tr>
      </thead>
      <tbody>
        {metrics.map((metric) => (
          <MetricRow
            key={metric.metric}
            metric={metric}
            {...{ scores, pointed }}
            points={counting === true && !several}
          />
        ))}
      </tbody>
    </table>
  );
}

interface RowParts {
  metric: ScoredMetric;
  scores: readonly (Score | null)[];
  pointed: { value: Pointed | null };
  points: boolean;
}

/** One metric; pointed at or focused, it explains itself. */
function MetricRow({ metric, scores, pointed, points }: RowParts) {
  const key = metric.metric;
  const point = (event: { currentTarget: HTMLElement }) =>
    (pointed.value = { metric: key, beside: event.currentTarget.getBoundingClientRect() });
  const leave = () => {
    if (pointed.value?.metric === key) pointed.value = null;
  };
  const each = scores.map((score) => score?.metrics.find((one) => one.metric === key) ?? null);
  return (
    <tr data-testid={`metric-${key}`} onMouseEnter={point} onMouseLeave={leave}>
      <th scope="row">
        <button
          type="button"
          class="metric-name"
          aria-describedby={pointed.value?.metric === key ? 'metric-card' : undefined}
          onFocus={(event) => point({ currentTarget: event.currentTarget.closest('tr') ?? event.currentTarget })}
          onBlur={leave}
          onKeyDown={(event) => {
            if (event.key === 'Escape') leave();
          }}
        >
          {metric.name}
          {metric.critical && (
            <span class="critical" title={reviewText.critical}>
              {' '}
              !<span class="visually-hidden"> {reviewText.critical}</span>
            </span>
          )}
        </button>
      </th>
      {each.map((one, i) => (
        <td key={i} class="number">
          {one === null ? '' : valueText(one)}
          {one !== null && <VerdictSign verdict={one.verdict} />}
        </td>
      ))}
      {points && <td class="number">{metric.points === null ? '–' : number(metric.points)}</td>}
    </tr>
  );
}

function VerdictSign({ verdict }: { verdict: Verdict }) {
  if (verdict === null) return <span class="verdict" />;
  return (
    <span class={`verdict verdict-${verdict}`} title={reviewText.verdict[verdict]}>
      <span aria-hidden="true">{{ pass: '●', warn: '▲', fail: '⬣' }[verdict]}</span>
      <span class="visually-hidden">{reviewText.verdict[verdict]}</span>
    </span>
  );
}
