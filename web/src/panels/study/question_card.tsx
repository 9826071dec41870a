import type { QuestionnaireDraft } from '../../state/study/questionnaire_draft';
import { questionnaireText as text } from '../../text/questionnaire_text';
import type { QuestionnaireItem } from '../../wire/rest_types';
import { Button } from '../common/button';
import { FaultField } from '../common/fault_field';
import { Check } from '../common/form_fields';
import { LineField } from './line_field';
import { QuestionDetails } from './question_details';

interface Parts {
  draft: QuestionnaireDraft;
  item: QuestionnaireItem;
  /** From 0. */
  place: number;
  last: boolean;
  /** Begins the ids of its fields. */
  fieldId: string;
  change: (changes: Partial<QuestionnaireItem>) => void;
  move: (by: -1 | 1) => void;
  remove: () => void;
}

/** One question while it is written, and its place among the others. */
export function QuestionCard({ draft, item, place, last, fieldId, change, move, remove }: Parts) {
  const faults = draft.faults.value;
  const fault = (field: string) => faults.get(`${place}/${field}`);
  return (
    <li class="criterion" data-testid={`edit-question-${place + 1}`}>
      <fieldset>
        <legend>
          {text.question(place + 1)} <span class="soft">({text.kinds[item.kind]})</span>
        </legend>
        <FaultField label={text.words} id={`${fieldId}-words`} fault={fault('words')}>
          {(described) => (
            <textarea
              rows={2}
              maxLength={1000}
              {...described}
              data-testid={`words-${place + 1}`}
              value={item.words}
              onInput={(event) => change({ words: event.currentTarget.value })}
            />
          )}
        </FaultField>
        <QuestionDetails {...{ item, fieldId, fault, change }} />
        <div class="criterion-line">
          <LineField
            label={text.id}
            id={`${fieldId}-id`}
            fault={fault('id')}
            value={item.id}
            onInput={(id) => change({ id })}
          />
          <LineField
            label={text.section}
            id={`${fieldId}-section`}
            fault={undefined}
            value={item.section}
            onInput={(section) => change({ section })}
          />
          <Check
            {...{ label: text.required, testId: `required-${place + 1}`, checked: item.required }}
            onChange={(required) => change({ required })}
          />
        </div>
        <div class="criterion-line">
          <Move {...{ fieldId, place, last, move }} />
          <Button testId={`remove-question-${place + 1}`} label={text.removeOf(place + 1)} onClick={remove}>
            {text.remove}
          </Button>
        </div>
      </fieldset>
    </li>
  );
}

function Move({ fieldId, place, last, move }: Pick<Parts, 'fieldId' | 'place' | 'last' | 'move'>) {
  return (
    <>
      {(
        [
          ['up', -1, text.up, text.upOf(place + 1), place === 0],
          ['down', 1, text.down, text.downOf(place + 1), last],
        ] as const
      ).map(([name, by, words, label, disabled]) => (
        <button
          key={name}
          type="button"
          class="plain-button"
          id={`${fieldId}-${name}`}
          data-testid={`${name}-${place + 1}`}
          aria-label={label}
          disabled={disabled}
          onClick={() => move(by)}
        >
          {words}
        </button>
      ))}
    </>
  );
}
