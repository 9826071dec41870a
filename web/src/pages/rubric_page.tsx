import { PageHeader } from '../panels/common/page_header';
import { Message } from '../panels/common/fields';
import { useRemote } from '../panels/common/use_remote';
import { useShownName } from '../panels/common/use_shown_name';
import { RubricEditor, SaveBar } from '../panels/rubric/rubric_editor';
import { addressOfRoute } from '../state/route';
import { RubricDraft } from '../state/rubric/rubric_draft';
import { rubricText } from '../text/rubric_text';
import type { RubricApi } from '../wire/rubric_api';

/** One rubric, to be edited. */
export function RubricPage({ api, id }: { api: RubricApi; id: string }) {
  const opened = useRemote(async () => {
    const [kept, metrics] = await Promise.all([api.rubric(id), api.metrics()]);
    return { name: kept.rubric.name, draft: new RubricDraft(kept, metrics) };
  });
  const draft = opened.value.value?.draft ?? null;
  const problem = opened.problem.value;
  useShownName(opened.value.value?.name ?? '');
  return (
    <div class="page content-page">
      <PageHeader here="rubrics" />
      <main class="content" data-testid="rubric">
        {draft === null ? <Opening problem={problem} /> : <RubricEditor api={api} id={id} draft={draft} />}
      </main>
      {draft !== null && <SaveBar api={api} id={id} draft={draft} />}
    </div>
  );
}

/** Until it is there, or why it is not. */
function Opening({ problem }: { problem: string | null }) {
  return (
    <section class="content-panel">
      <p>
        <a href={addressOfRoute({ kind: 'rubrics' })}>‹ {rubricText.back}</a>
      </p>
      {problem === null ? <p class="soft">{rubricText.loading}</p> : <Message kind="bad">{problem}</Message>}
    </section>
  );
}
