import { useSignal } from '@preact/signals';

import { Button } from '../panels/common/button';
import { ColumnHeads } from '../panels/common/column_heads';
import { Message } from '../panels/common/fields';
import { Choice, TextLine } from '../panels/common/form_fields';
import { PageHeader } from '../panels/common/page_header';
import { useRemote } from '../panels/common/use_remote';
import type { Remote } from '../state/remote';
import { addressOfRoute } from '../state/route';
import { rubricId } from '../state/rubric/rubric_draft';
import { rubricText } from '../text/rubric_text';
import type { RubricSummary } from '../wire/rest_types';
import type { RubricApi } from '../wire/rubric_api';

/** What sessions can be scored by, and making another. */
export function RubricsPage({ api }: { api: RubricApi }) {
  const rubrics = useRemote(() => api.rubrics());
  const list = rubrics.value.value;
  const problem = rubrics.problem.value;
  return (
    <div class="page content-page">
      <PageHeader here="rubrics" />
      <main class="content">
        <section class="content-panel" aria-labelledby="rubrics-title" data-testid="rubrics">
          <div class="content-head">
            <h2 id="rubrics-title">{rubricText.rubrics}</h2>
            <a class="content-count" data-testid="to-benchmarks" href={addressOfRoute({ kind: 'benchmarks' })}>
              {rubricText.toBenchmarks}
            </a>
          </div>
          <p class="soft">
            {rubricText.hint} {rubricText.standardHint}
          </p>
          {problem !== null && <Message kind="bad">{problem}</Message>}
          {list === null && problem === null && <p class="soft">{rubricText.loading}</p>}
          {list !== null && <RubricTable list={list} />}
        </section>
        {list !== null && <NewRubric api={api} rubrics={rubrics} list={list} />}
      </main>
    </div>
  );
}

function RubricTable({ list }: { list: readonly RubricSummary[] }) {
  return (
    <div class="table-scroll">
      <table class="data-table">
        <ColumnHeads names={[rubricText.nameColumn, rubricText.versionColumn, rubricText.passColumn]} numbersFrom={1} />
        <tbody>
          {list.map(({ id, name, version, pass_points }) => (
            <tr key={id} data-testid={`rubric-${id}`}>
              <td>
                <a href={addressOfRoute({ kind: 'rubric', id })}>{name}</a>
              </td>
              <td class="number">{version}</td>
              <td class="number">{pass_points ?? rubricText.noPassMark}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

interface NewParts {
  api: RubricApi;
  rubrics: Remote<RubricSummary[]>;
  list: readonly RubricSummary[];
}

/** A copy of one that there is, opened at once. */
function NewRubric({ api, rubrics, list }: NewParts) {
  const from = useSignal('standard');
  const typed = useSignal<string | null>(null);
  const chosen = list.find(({ id }) => id === from.value);
  const name = typed.value ?? rubricText.copyOf(chosen?.name ?? from.value);
  const create = async (event: Event) => {
    event.preventDefault();
    const id = rubricId(
      name,
      list.map((one) => one.id),
    );
    const made = await rubrics.act(async () => {
      const { rubric } = await api.rubric(from.value);
      return api.create(id, { ...rubric, name: name.trim(), version: 1 });
    });
    if (made !== null) window.location.hash = addressOfRoute({ kind: 'rubric', id });
  };
  return (
    <section class="content-panel" aria-labelledby="new-rubric">
      <h2 id="new-rubric">{rubricText.make}</h2>
      <form class="content-form" onSubmit={(event) => void create(event)}>
        <Choice
          {...{ label: rubricText.basedOn, testId: 'rubric-from', value: from.value }}
          options={list.map((one) => [one.id, one.name] as const)}
          onChange={(id) => (from.value = id)}
        />
        <TextLine
          {...{ label: rubricText.name, testId: 'rubric-name', required: true, maxLength: 200, value: name }}
          onInput={(text) => (typed.value = text)}
        />
        <Button submit look="main" testId="create-rubric" disabled={rubrics.busy.value}>
          {rubricText.create}
        </Button>
      </form>
    </section>
  );
}
