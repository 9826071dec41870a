import { useSignal } from '@preact/signals';

import { ColumnHeads } from '../panels/common/column_heads';
import { PageHeader } from '../panels/common/page_header';
import { Message } from '../panels/common/fields';
import { useRemote } from '../panels/common/use_remote';
import { BenchmarkPanel } from '../panels/rubric/benchmark_panel';
import { NewBenchmarkPanel } from '../panels/rubric/new_benchmark';
import { addressOfRoute } from '../state/route';
import { benchmarkText } from '../text/benchmark_text';
import { dayAndTime } from '../text/format';
import type { BenchmarkSummary } from '../wire/rest_types';
import type { RubricApi } from '../wire/rubric_api';

/** What experts reach: those that there are, one of them in full, and making another. */
export function BenchmarksPage({ api }: { api: RubricApi }) {
  const benchmarks = useRemote(() => api.benchmarks());
  const opened = useSignal<string | null>(null);
  const list = benchmarks.value.value;
  const problem = benchmarks.problem.value;
  return (
    <div class="page content-page">
      <PageHeader here="rubrics" />
      <main class="content">
        <section class="content-panel" aria-labelledby="benchmarks-title" data-testid="benchmarks">
          <p>
            <a href={addressOfRoute({ kind: 'rubrics' })}>‹ {benchmarkText.back}</a>
          </p>
          <h2 id="benchmarks-title">{benchmarkText.benchmarks}</h2>
          <p class="soft">{benchmarkText.hint}</p>
          {problem !== null && (
            <Message kind="bad" testId="benchmark-problem">
              {problem}
            </Message>
          )}
          {list === null && problem === null && <p class="soft">{benchmarkText.loading}</p>}
          {list?.length === 0 && <p class="soft">{benchmarkText.none}</p>}
          {list !== null && list.length > 0 && <BenchmarkTable list={list} open={(id) => (opened.value = id)} />}
        </section>
        {opened.value !== null && (
          <BenchmarkPanel key={opened.value} api={api} id={opened.value} close={() => (opened.value = null)} />
        )}
        <NewBenchmarkPanel api={api} benchmarks={benchmarks} onMade={(id) => (opened.value = id)} />
      </main>
    </div>
  );
}

function BenchmarkTable({ list, open }: { list: readonly BenchmarkSummary[]; open: (id: string) => void }) {
  const { nameColumn, whenColumn, expertsColumn, novicesColumn, metricsColumn } = benchmarkText;
  return (
    <div class="table-scroll">
      <table class="data-table">
        <ColumnHeads names={[nameColumn, whenColumn, expertsColumn, novicesColumn, metricsColumn]} numbersFrom={2} />
        <tbody>
          {list.map(({ id, name, created_utc, experts, novices, metrics }) => (
            <tr key={id} data-testid={`benchmark-${id}`}>
              <td>
                <button type="button" class="link-button" onClick={() => open(id)}>
                  {name}
                </button>
              </td>
              <td class="when">{dayAndTime(created_utc)}</td>
              {[experts, novices, metrics].map((count, i) => (
                <td key={i} class="number">
                  {count}
                </td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
