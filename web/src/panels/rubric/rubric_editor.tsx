import { useSignal } from '@preact/signals';

import { addressOfRoute } from '../../state/route';
import type { RubricDraft } from '../../state/rubric/rubric_draft';
import { rubricText } from '../../text/rubric_text';
import { ApiError, messageOf } from '../../wire/rest';
import type { RubricApi } from '../../wire/rubric_api';
import { Button } from '../common/button';
import { Message } from '../common/fields';
import { CriteriaPanel } from './criteria_panel';
import { FaultField, NumberLine } from '../common/fault_field';
import { useUnsavedGuard } from '../common/use_unsaved_guard';
import { PreviewPanel } from './preview_panel';

interface Parts {
  api: RubricApi;
  id: string;
  draft: RubricDraft;
}

/** A rubric with all that it says, and what it makes of a session. */
export function RubricEditor({ api, id, draft }: Parts) {
  useUnsavedGuard(draft, ({ changed }) => changed.peek(), rubricText.leave);
  return (
    <div class="rubric-editor">
      <div class="rubric-form">
        <section class="content-panel" aria-labelledby="rubric-title">
          <p>
            <a href={addressOfRoute({ kind: 'rubrics' })} data-testid="to-all-rubrics">
              ‹ {rubricText.back}
            </a>
          </p>
          <div class="content-head">
            <h2 id="rubric-title">{rubricText.edit}</h2>
            <span class="soft content-count" data-testid="rubric-version">
              {rubricText.version(draft.version.value)}
            </span>
          </div>
          {id === 'standard' && <Message kind="warn">{rubricText.editsStandard}</Message>}
          <HeadFields draft={draft} />
        </section>
        <CriteriaPanel draft={draft} />
      </div>
      <PreviewPanel {...{ api, id, draft }} />
    </div>
  );
}

function HeadFields({ draft }: { draft: RubricDraft }) {
  const { name, passPoints, leastMeasured, remark } = draft.content.value;
  const faults = draft.faults.value;
  return (
    <div class="rubric-head">
      <FaultField label={rubricText.name} id="rubric-name" fault={faults.get('name')}>
        {(described) => (
          <input
            type="text"
            maxLength={200}
            {...described}
            data-testid="rubric-name"
            value={name}
            onInput={(event) => draft.set({ name: event.currentTarget.value })}
          />
        )}
      </FaultField>
      <NumberLine
        {...{ label: rubricText.passMark, id: 'rubric-pass', fault: faults.get('pass_points'), value: passPoints }}
        onInput={(typed) => draft.set({ passPoints: typed })}
      />
      <NumberLine
        {...{ label: rubricText.leastMeasured, id: 'rubric-least', value: leastMeasured }}
        fault={faults.get('least_said_percent')}
        onInput={(typed) => draft.set({ leastMeasured: typed })}
      />
      <p class="soft wide">
        {rubricText.passMarkHint} {rubricText.leastMeasuredHint}
      </p>
      <label class="wide">
        {rubricText.remark}
        <textarea
          rows={3}
          maxLength={4000}
          value={remark}
          onInput={(event) => draft.set({ remark: event.currentTarget.value })}
        />
      </label>
    </div>
  );
}

/** Saves, or says what is in the way. Stands below the rest, and covers nothing of it. */
export function SaveBar({ api, id, draft }: Parts) {
  const status = useSignal<{ kind: 'soft' | 'bad'; words: string } | null>(null);
  const busy = useSignal(false);
  const faults = draft.faults.value.size;
  const save = async () => {
    const rubric = draft.rubric.peek();
    if (rubric === null) return;
    const sent = draft.content.peek();
    busy.value = true;
    try {
      draft.take(await api.save(id, rubric), sent);
      status.value = { kind: 'soft', words: rubricText.saved(draft.version.value) };
    } catch (error) {
      if (error instanceof ApiError) draft.refuse(error.faults);
      const conflict = error instanceof ApiError && error.status === 409;
      status.value = { kind: 'bad', words: conflict ? rubricText.conflict : messageOf(error) };
    } finally {
      busy.value = false;
    }
  };
  return (
    <section class="save-bar" data-testid="save-bar" aria-label={rubricText.save}>
      <Button
        look="main"
        testId="save-rubric"
        disabled={busy.value || !draft.changed.value || faults > 0}
        onClick={() => void save()}
      >
        {rubricText.save}
      </Button>
      {draft.changed.value && (
        <span class="soft" data-testid="unsaved">
          {rubricText.unsaved}
        </span>
      )}
      <span role="status">
        {faults > 0 && (
          <Message kind="warn" testId="rubric-faults">
            {rubricText.faults(faults)}
          </Message>
        )}
        {status.value !== null && !draft.changed.value && status.value.kind === 'soft' && (
          <span data-testid="rubric-saved">{status.value.words}</span>
        )}
      </span>
      {status.value?.kind === 'bad' && (
        <Message kind="bad" testId="rubric-problem">
          {status.value.words}
        </Message>
      )}
    </section>
  );
}
