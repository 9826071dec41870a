import { withOption } from '../../state/study/questionnaire_draft';
import { questionnaireText as text } from '../../text/questionnaire_text';
import type { ChoiceItem, LikertItem, QuestionnaireItem } from '../../wire/rest_types';
import { Button } from '../common/button';
import { Fault, NumberLine } from '../common/fault_field';
import { Check, Choice } from '../common/form_fields';
import { LineField } from './line_field';

interface Parts<T extends QuestionnaireItem> {
  item: T;
  fieldId: string;
  fault: (field: string) => string | undefined;
  change: (changes: Partial<QuestionnaireItem>) => void;
}

/** What a question of its kind has besides its words. */
export function QuestionDetails(parts: Parts<QuestionnaireItem>) {
  const { item, fieldId, fault, change } = parts;
  switch (item.kind) {
    case 'likert':
      return <Scale {...parts} item={item} />;
    case 'choice':
      return <Options {...parts} item={item} />;
    case 'text':
      return (
        <div class="criterion-line">
          <NumberLine
            {...{ label: text.longest, id: `${fieldId}-longest`, fault: fault('longest') }}
            value={Number.isNaN(item.longest) ? '' : String(item.longest)}
            onInput={(longest) => change({ longest: longest === '' ? NaN : Number(longest) })}
          />
        </div>
      );
  }
}

function Scale({ item, fieldId, fault, change }: Parts<LikertItem>) {
  return (
    <div class="criterion-line">
      <Choice
        {...{ label: text.points, testId: `${fieldId}-points`, value: String(item.points) }}
        options={[
          ['5', '5'],
          ['7', '7'],
        ]}
        onChange={(points) => change({ points: points === '7' ? 7 : 5 })}
      />
      {(['low', 'middle', 'high'] as const).map((end) => (
        <LineField
          key={end}
          {...{ label: text[end], id: `${fieldId}-${end}`, fault: fault(end), value: item[end] }}
          onInput={(words) => change({ [end]: words })}
        />
      ))}
      <Check
        {...{ label: text.cannotJudge, testId: `${fieldId}-cannot-judge`, checked: item.cannot_judge }}
        onChange={(cannot_judge) => change({ cannot_judge })}
      />
    </div>
  );
}

function Options({ item, fieldId, fault, change }: Parts<ChoiceItem>) {
  const { options } = item;
  const bad = fault('options');
  return (
    <div role="group" aria-label={text.options}>
      {options.map((option, i) => (
        <div class="criterion-line options-line" key={option.id}>
          <LineField
            {...{ label: text.option(i + 1), id: `${fieldId}-option-${i + 1}`, testId: `option-${option.id}` }}
            {...{ fault: fault(`options/${i}`), value: option.words }}
            onInput={(words) => change({ options: options.map((one, at) => (at === i ? { ...one, words } : one)) })}
          />
          {options.length > 2 && (
            <Button
              label={text.removeOption(i + 1)}
              onClick={() => change({ options: options.filter((_, at) => at !== i) })}
            >
              {text.remove}
            </Button>
          )}
        </div>
      ))}
      {bad !== undefined && <Fault id={`${fieldId}-options-fault`} words={bad} />}
      <div class="criterion-line">
        <Button onClick={() => change({ options: withOption(options) })}>{text.addOption}</Button>
        <Check
          {...{ label: text.several, testId: `${fieldId}-several`, checked: item.several }}
          onChange={(several) => change({ several })}
        />
      </div>
    </div>
  );
}
