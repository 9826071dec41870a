import { useMemo } from 'preact/hooks';

import type { Remote } from '../../state/remote';
import { BenchmarkDraft, type Group } from '../../state/rubric/benchmark_draft';
import { benchmarkText } from '../../text/benchmark_text';
import type { BenchmarkSummary, Session } from '../../wire/rest_types';
import type { RubricApi } from '../../wire/rubric_api';
import { Button } from '../common/button';
import { ColumnHeads } from '../common/column_heads';
import { Message } from '../common/fields';
import { Choice, TextLine } from '../common/form_fields';
import { sessionLabel } from '../common/trainee_label';
import { useRemote } from '../common/use_remote';

const offered = 100;

interface Parts {
  api: RubricApi;
  benchmarks: Remote<BenchmarkSummary[]>;
  onMade: (id: string) => void;
}

/** The form for another benchmark: whose sessions, and what it is called. */
export function NewBenchmarkPanel({ api, benchmarks, onMade }: Parts) {
  const draft = useMemo(() => new BenchmarkDraft(), []);
  const found = useRemote(async () => {
    const [sessions, rubrics] = await Promise.all([api.ended(offered), api.rubrics()]);
    return { sessions, rubrics };
  });
  const { sessions, rubrics } = found.value.value ?? { sessions: null, rubrics: [] };
  const missing = draft.missing.value;
  const make = async (event: Event) => {
    event.preventDefault();
    const made = await benchmarks.act(() => api.addBenchmark(draft.benchmark()));
    if (made === null) return;
    draft.clear();
    onMade(made.id);
  };
  return (
    <section class="content-panel" aria-labelledby="new-benchmark">
      <h2 id="new-benchmark">{benchmarkText.make}</h2>
      <p class="soft">{benchmarkText.makeHint}</p>
      {found.problem.value !== null && <Message kind="bad">{found.problem.value}</Message>}
      {sessions?.length === 0 && <p class="soft">{benchmarkText.noSessions}</p>}
      {sessions !== null && sessions.length > 0 && (
        <form onSubmit={(event) => void make(event)}>
          <SessionPicker draft={draft} sessions={sessions} />
          <div class="content-form">
            <TextLine
              {...{ label: benchmarkText.name, testId: 'benchmark-name', required: true, maxLength: 200 }}
              value={draft.name.value}
              onInput={(name) => (draft.name.value = name)}
            />
            {draft.novices.value.length > 0 && (
              <Choice
                {...{ label: benchmarkText.rubric, testId: 'benchmark-rubric', value: draft.rubric.value }}
                options={rubrics.map(({ id, name }) => [id, name] as const)}
                onChange={(rubric) => (draft.rubric.value = rubric)}
              />
            )}
            <Button submit look="main" testId="create-benchmark" disabled={missing !== null || benchmarks.busy.value}>
              {benchmarkText.create}
            </Button>
            <p class="soft wide" role="status" data-testid="benchmark-chosen">
              {benchmarkText.chosen(draft.experts.value.length, draft.novices.value.length)} {missing}
            </p>
          </div>
        </form>
      )}
    </section>
  );
}

function SessionPicker({ draft, sessions }: { draft: BenchmarkDraft; sessions: readonly Session[] }) {
  return (
    <>
      {sessions.length >= offered && <p class="soft">{benchmarkText.newest(sessions.length)}</p>}
      <div class="table-scroll picker" tabIndex={0} role="region" aria-label={benchmarkText.sessions}>
        <table class="data-table">
          <ColumnHeads names={[benchmarkText.groupColumn, benchmarkText.sessionColumn]} />
          <tbody>
            {sessions.map((session) => (
              <SessionRow key={session.id} draft={draft} session={session} />
            ))}
          </tbody>
        </table>
      </div>
    </>
  );
}

function SessionRow({ draft, session }: { draft: BenchmarkDraft; session: Session }) {
  const { id } = session;
  return (
    <tr>
      <td>
        <select
          aria-label={benchmarkText.groupOf(id)}
          data-testid={`group-${id}`}
          value={draft.groupOf(id)}
          onChange={(event) => draft.put(id, event.currentTarget.value as Group)}
        >
          {Object.entries(benchmarkText.groups).map(([group, words]) => (
            <option key={group} value={group}>
              {words}
            </option>
          ))}
        </select>
      </td>
      <td>{sessionLabel(session)}</td>
    </tr>
  );
}
