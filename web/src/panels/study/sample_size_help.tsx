import { useEffect, useMemo } from 'preact/hooks';

import { fieldsOf, rangeOf, type SampleField, SampleSizeForm } from '../../state/study/sample_size';
import { feelText } from '../../text/feel_text';
import { sentence } from '../../text/format';
import type { SampleQuestion } from '../../wire/rest_types';
import type { StudyApi } from '../../wire/study_api';
import { Message } from '../common/fields';
import { Choice } from '../common/form_fields';

/** How many participants a study that is being planned needs; asked for once it is unfolded. */
export function SampleSizeHelp({ api }: { api: StudyApi }) {
  const form = useMemo(() => new SampleSizeForm(api), [api]);
  useEffect(() => () => form.dispose(), [form]);
  const { question, answer, problem } = form;
  const unfold = (open: boolean) => {
    if (open && answer.value === null) void form.ask();
  };
  return (
    <details class="sample-size" data-testid="sample-size" onToggle={(event) => unfold(event.currentTarget.open)}>
      <summary>{feelText.sample}</summary>
      <div class="content-form">
        <Choice
          {...{ label: feelText.sampleQuestion, testId: 'sample-question', value: question.value }}
          options={feelText.sampleQuestions}
          onChange={(chosen) => form.choose(chosen as SampleQuestion)}
        />
        {fieldsOf[question.value].map((field) => (
          <NumberInput key={field} form={form} field={field} />
        ))}
      </div>
      <div role="status" data-testid="sample-answer">
        {answer.value !== null && (
          <>
            <p class="sample-answer">{answer.value.size}</p>
            <p class="soft">{sentence(feelText.source(answer.value.source))}</p>
          </>
        )}
      </div>
      {problem.value !== null && (
        <Message kind="bad" testId="sample-problem">
          {problem.value}
        </Message>
      )}
    </details>
  );
}

function NumberInput({ form, field }: { form: SampleSizeForm; field: SampleField }) {
  const value = form.values.value[field];
  return (
    <label>
      {feelText.sampleFields[field]}
      <input
        type="number"
        {...rangeOf[field]}
        data-testid={`sample-${field}`}
        value={Number.isFinite(value) ? value : ''}
        onInput={(event) => form.set(field, event.currentTarget.valueAsNumber)}
      />
    </label>
  );
}
