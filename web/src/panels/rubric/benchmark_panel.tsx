import { number, valueText } from '../../state/review/score_text';
import { benchmarkText } from '../../text/benchmark_text';
import type { Benchmark, KnownMetric } from '../../wire/rest_types';
import type { RubricApi } from '../../wire/rubric_api';
import { Button } from '../common/button';
import { ColumnHeads } from '../common/column_heads';
import { Message } from '../common/fields';
import { useRemote } from '../common/use_remote';

/** All that one benchmark says. */
export function BenchmarkPanel({ api, id, close }: { api: RubricApi; id: string; close: () => void }) {
  const opened = useRemote(async () => {
    const [benchmark, metrics] = await Promise.all([api.benchmark(id), api.metrics()]);
    return { benchmark, metrics };
  });
  const { benchmark, metrics } = opened.value.value ?? { benchmark: null, metrics: [] };
  const problem = opened.problem.value;
  return (
    <section class="content-panel" aria-labelledby="benchmark-title" data-testid="benchmark">
      <div class="content-head">
        <h2 id="benchmark-title">{benchmarkText.of(benchmark?.name ?? '…')}</h2>
        <Button onClick={close}>{benchmarkText.close}</Button>
      </div>
      {problem !== null && <Message kind="bad">{problem}</Message>}
      {benchmark !== null && <Lines {...{ benchmark, metrics }} />}
      {benchmark !== null && benchmark.cuts.length > 0 && <Cuts {...{ benchmark, metrics }} />}
    </section>
  );
}

interface Parts {
  benchmark: Benchmark;
  metrics: readonly KnownMetric[];
}

interface TableParts {
  /** What it is about; shown where it is a part of more. */
  label: string;
  caption?: boolean;
  columns: readonly string[];
  rows: readonly (readonly string[])[];
}

/** A name, then numbers. */
function NumberTable({ label, caption, columns, rows }: TableParts) {
  return (
    <div class="table-scroll" role="region" aria-label={label} tabIndex={0}>
      <table class="data-table">
        {caption === true && <caption>{label}</caption>}
        <ColumnHeads names={columns} numbersFrom={1} />
        <tbody>
          {rows.map(([name, ...values]) => (
            <tr key={name}>
              <td>{name}</td>
              {values.map((value, i) => (
                <td key={i} class="number">
                  {value}
                </td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function Lines({ benchmark, metrics }: Parts) {
  const { metricColumn, meanColumn, sdColumn, countColumn } = benchmarkText;
  return (
    <NumberTable
      label={metricColumn}
      columns={[metricColumn, meanColumn, sdColumn, countColumn]}
      rows={benchmark.lines.map(({ metric, mean, sd, experts }) => {
        const known = metrics.find((one) => one.metric === metric);
        const unit = known?.unit ?? null;
        return [
          known?.name ?? metric,
          valueText({ value: mean, unit }),
          valueText({ value: sd, unit }),
          String(experts),
        ];
      })}
    />
  );
}

function Cuts({ benchmark, metrics }: Parts) {
  const { metricColumn, cutColumn, noviceColumn, expertColumn, points } = benchmarkText;
  const known = (of: string) => metrics.find(({ metric }) => metric === of);
  return (
    <NumberTable
      label={benchmarkText.cuts}
      caption
      columns={[metricColumn, cutColumn, noviceColumn, expertColumn]}
      rows={benchmark.cuts.map((cut) => {
        const name = cut.of === 'points' ? points : (known(cut.of)?.name ?? cut.of);
        if ('error' in cut) return [name, cut.error, '', ''];
        const unit = known(cut.of)?.unit ?? null;
        const mark = cut.of === 'points' ? number(cut.cut) : valueText({ value: cut.cut, unit });
        return [name, mark, `${cut.novices_passing} / ${cut.novices}`, `${cut.experts_failing} / ${cut.experts}`];
      })}
    />
  );
}
