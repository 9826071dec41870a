import type { AnswerSheet } from '../../state/study/answer_sheet';
import { studyText } from '../../text/study_text';
import type { ChoiceItem, QuestionnaireItem, LikertItem, TextItem } from '../../wire/rest_types';

interface Parts<T extends QuestionnaireItem> {
  item: T;
  sheet: AnswerSheet;
}

/** One thing that is asked, as a group that keys and screen readers know: radio buttons, boxes or a text. */
export function Question({ item, sheet }: Parts<QuestionnaireItem>) {
  const bad = sheet.tried.value && sheet.missing.value.includes(item);
  const id = questionId(item);
  if (item.kind === 'text') return <TextQuestion item={item} sheet={sheet} bad={bad} />;
  return (
    <fieldset
      id={id}
      class={bad ? 'question question-bad' : 'question'}
      data-testid={`question-${item.id}`}
      aria-invalid={bad}
      aria-describedby={bad ? `${id}-fault` : undefined}
    >
      <legend>
        <QuestionText item={item} />
      </legend>
      {item.kind === 'likert' && <LikertAnswers item={item} sheet={sheet} />}
      {item.kind === 'choice' && <ChoiceAnswers item={item} sheet={sheet} />}
      {bad && <Fault of={id} message={studyText.needed} />}
    </fieldset>
  );
}

function QuestionText({ item }: { item: QuestionnaireItem }) {
  return (
    <>
      {item.words} {!item.required && <span class="soft">({studyText.optional})</span>}
    </>
  );
}

/** What is wrong with an answer. */
function Fault({ of, message }: { of: string; message: string }) {
  return (
    <p id={`${of}-fault`} class="question-fault">
      {message}
    </p>
  );
}

/** Of the element that a question is. */
export function questionId(item: QuestionnaireItem): string {
  return `question-${item.id}`;
}

function LikertAnswers({ item, sheet }: Parts<LikertItem>) {
  const answer = sheet.answers.value[item.id];
  const points = Array.from({ length: item.points }, (_, i) => i + 1);
  const label = (at: number) =>
    at === 1
      ? studyText.lowest(at, item.low)
      : at === item.points
        ? studyText.lowest(at, item.high)
        : studyText.points(at, item.points);
  return (
    <div class="likert">
      <span class="likert-end" aria-hidden="true">
        {item.low}
      </span>
      <span class="likert-points">
        {points.map((at) => (
          <label key={at}>
            <input
              type="radio"
              name={item.id}
              aria-label={label(at)}
              data-testid={`${item.id}-${at}`}
              checked={answer === at}
              onChange={() => sheet.set(item.id, at)}
            />
            <span aria-hidden="true">{at}</span>
          </label>
        ))}
      </span>
      <span class="likert-end likert-high" aria-hidden="true">
        {item.high}
      </span>
      {item.middle !== '' && <p class="likert-middle soft">{studyText.middle((item.points + 1) / 2, item.middle)}</p>}
      {item.cannot_judge && (
        <label class="likert-none">
          <input
            type="radio"
            name={item.id}
            data-testid={`${item.id}-none`}
            checked={answer === null}
            onChange={() => sheet.set(item.id, null)}
          />
          {studyText.cannotJudge}
        </label>
      )}
    </div>
  );
}

function ChoiceAnswers({ item, sheet }: Parts<ChoiceItem>) {
  const answer = sheet.answers.value[item.id];
  const chosen = (id: string) => (Array.isArray(answer) ? answer.includes(id) : answer === id);
  return (
    <div class="choices">
      {item.options.map((option) => (
        <label key={option.id}>
          <input
            type={item.several ? 'checkbox' : 'radio'}
            name={item.id}
            data-testid={`${item.id}-${option.id}`}
            checked={chosen(option.id)}
            onChange={() => (item.several ? sheet.toggle(item.id, option.id) : sheet.set(item.id, option.id))}
          />
          {option.words}
        </label>
      ))}
    </div>
  );
}

function TextQuestion({ item, sheet, bad }: Parts<TextItem> & { bad: boolean }) {
  const id = questionId(item);
  const answer = sheet.answers.value[item.id];
  const text = typeof answer === 'string' ? answer : '';
  const tooLong = [...text].length > item.longest;
  return (
    <div class={bad ? 'question question-bad' : 'question'} data-testid={`question-${item.id}`}>
      <label for={id}>
        <QuestionText item={item} />
      </label>
      <textarea
        id={id}
        rows={3}
        data-testid={`${item.id}-text`}
        aria-invalid={bad}
        aria-describedby={bad || tooLong ? `${id}-fault` : undefined}
        value={text}
        onInput={(event) => sheet.set(item.id, event.currentTarget.value || undefined)}
      />
      {(bad || tooLong) && <Fault of={id} message={tooLong ? studyText.tooLong(item.longest) : studyText.needed} />}
    </div>
  );
}
