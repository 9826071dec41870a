import { feelComparisons, type FeelDraft, minutesPerTrial, trialCounts } from '../../state/study/feel_draft';
import { feelText } from '../../text/feel_text';
import { Check, Choice } from '../common/form_fields';

/** What a blind study of feel asks, and how often. */
export function FeelFields({ draft }: { draft: FeelDraft }) {
  const { trials } = draft;
  return (
    <>
      <Choice
        {...{ label: feelText.trialsEach, testId: 'feel-trials', value: String(draft.trialsEach.value) }}
        options={trialCounts.map((count) => [String(count), String(count)])}
        onChange={(chosen) => (draft.trialsEach.value = trialCounts.find((one) => String(one) === chosen) ?? 8)}
      />
      <fieldset class="wide">
        <legend>{feelText.comparisons}</legend>
        <p class="soft">{feelText.about}</p>
        {feelComparisons.map((comparison) => (
          <Check
            key={comparison}
            {...{ label: feelText.comparisonNames[comparison], testId: `feel-${comparison}` }}
            checked={draft.comparisons.value.includes(comparison)}
            onChange={() => draft.toggle(comparison)}
          />
        ))}
        <p class="soft" role="status" data-testid="feel-trial-count">
          {trials > 0 && feelText.trials(trials, trials * minutesPerTrial)}
        </p>
      </fieldset>
    </>
  );
}
