import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import type { ItemKind, QuestionnaireDraft } from '../../state/study/questionnaire_draft';
import { questionnaireText as text } from '../../text/questionnaire_text';
import { saveBlob } from '../../wire/save_blob';
import { Button } from '../common/button';
import { Fault, FaultField } from '../common/fault_field';
import { Message } from '../common/fields';
import { QuestionCard } from './question_card';

interface Parts {
  draft: QuestionnaireDraft;
  /** Of a file that was chosen. */
  read: (file: File | undefined) => void;
  onPreview: () => void;
}

const kinds: readonly ItemKind[] = ['likert', 'choice', 'text'];

/** A study's own questionnaire: title and questions, in order. */
export function QuestionnaireEditor({ draft, read, onPreview }: Parts) {
  const faults = draft.faults.value;
  const save = () => {
    const json = JSON.stringify(draft.questionnaire.value, null, 2);
    saveBlob(new Blob([json], { type: 'application/json' }), text.fileName(draft.id.value));
  };
  return (
    <div class="wide questionnaire-editor" data-testid="questionnaire-editor">
      <label>
        {text.load}
        <input
          type="file"
          accept=".json,application/json"
          data-testid="questionnaire-file"
          onChange={(event) => read(event.currentTarget.files?.[0])}
        />
      </label>
      <Head draft={draft} />
      <Questions draft={draft} />
      <div class="criterion-line">
        <Button testId="preview-questionnaire" disabled={draft.items.value.length === 0} onClick={onPreview}>
          {text.preview}
        </Button>
        <Button testId="save-questionnaire" onClick={save}>
          {text.saveFile}
        </Button>
        <span role="status">
          {faults.size > 0 && (
            <Message kind="warn" testId="questionnaire-faults">
              {text.faults(faults.size)}
            </Message>
          )}
        </span>
      </div>
    </div>
  );
}

function Head({ draft }: { draft: QuestionnaireDraft }) {
  const faults = draft.faults.value;
  return (
    <div class="criterion-line">
      <FaultField label={text.title} id="questionnaire-title" fault={faults.get('title')}>
        {(described) => (
          <input
            type="text"
            maxLength={200}
            {...described}
            data-testid="questionnaire-title"
            value={draft.title.value}
            onInput={(event) => (draft.title.value = event.currentTarget.value)}
          />
        )}
      </FaultField>
      <FaultField label={text.id} id="questionnaire-id" fault={faults.get('id')}>
        {(described) => (
          <input
            type="text"
            autocapitalize="none"
            spellcheck={false}
            {...described}
            value={draft.id.value}
            onInput={(event) => (draft.id.value = event.currentTarget.value)}
          />
        )}
      </FaultField>
      <p class="soft wide">{text.idHint}</p>
      <label class="wide">
        {text.introduction}
        <textarea
          rows={2}
          maxLength={4000}
          value={draft.introduction.value}
          onInput={(event) => (draft.introduction.value = event.currentTarget.value)}
        />
      </label>
    </div>
  );
}

function Questions({ draft }: { draft: QuestionnaireDraft }) {
  const items = draft.items.value;
  /** What is to have the focus when the questions are drawn anew: of a question that was moved or added. */
  const focusOn = useSignal<{ ids: readonly string[]; said: string } | null>(null);
  useEffect(() => {
    const fields = (focusOn.value?.ids ?? []).map((id) => document.getElementById(id));
    fields.find((field) => field !== null && !field.matches(':disabled'))?.focus();
  }, [focusOn.value]);
  const move = (key: number, by: -1 | 1) => {
    draft.move(key, by);
    const at = draft.items.value.findIndex((one) => one.key === key);
    const ids = [`question-${key}-${by < 0 ? 'up' : 'down'}`, `question-${key}-${by < 0 ? 'down' : 'up'}`];
    focusOn.value = { ids, said: text.moved(at + 1, items.length) };
  };
  const none = draft.faults.value.get('items');
  return (
    <div role="group" aria-label={text.questions}>
      {none !== undefined && <Fault id="items-fault" words={none} />}
      <ol class="criteria">
        {items.map(({ key, item }, place) => (
          <QuestionCard
            key={key}
            {...{ draft, item, place, fieldId: `question-${key}`, last: place === items.length - 1 }}
            change={(changes) => draft.change(key, changes)}
            move={(by) => move(key, by)}
            remove={() => draft.remove(key)}
          />
        ))}
      </ol>
      <p class="visually-hidden" role="status">
        {focusOn.value?.said}
      </p>
      <div class="criterion-line">
        {kinds.map((kind) => (
          <Button
            key={kind}
            testId={`add-${kind}`}
            onClick={() => (focusOn.value = { ids: [`question-${draft.add(kind)}-words`], said: '' })}
          >
            {text.add[kind]}
          </Button>
        ))}
      </div>
    </div>
  );
}
