import { useSignal } from '@preact/signals';

import { type AnswerSheet, sectionsOf } from '../../state/study/answer_sheet';
import { studyText } from '../../text/study_text';
import { messageOf } from '../../wire/rest';
import { Button } from '../common/button';
import { Message } from '../common/fields';
import { Question, questionId } from './question';

interface Parts {
  sheet: AnswerSheet;
  /** Who answers about what. */
  about: string;
  /** Said once the server has the answers. */
  thanks: string;
  sendLabel: string;
  readOnly: boolean;
  send: (sheet: AnswerSheet) => Promise<unknown>;
}

/** A questionnaire or rating form while it is filled in; what is missing is said and gone to. */
export function AnswerForm({ sheet, about, thanks, sendLabel, readOnly, send }: Parts) {
  const busy = useSignal(false);
  const status = useSignal<{ kind: 'soft' | 'bad'; text: string } | null>(null);
  const { questionnaire } = sheet;
  const missing = sheet.missing.value;
  const submit = async (event: Event) => {
    event.preventDefault();
    sheet.tried.value = true;
    status.value = null;
    if (missing.length > 0) {
      goToFirstMissing(sheet);
      return;
    }
    busy.value = true;
    try {
      await send(sheet);
      sheet.sent();
      status.value = { kind: 'soft', text: thanks };
    } catch (error) {
      status.value = { kind: 'bad', text: messageOf(error) };
    } finally {
      busy.value = false;
    }
  };
  return (
    <form noValidate onSubmit={(event) => void submit(event)} data-testid="questionnaire" lang={questionnaire.language}>
      <h2>{questionnaire.title}</h2>
      <p class="soft">
        {questionnaire.introduction} {about}
      </p>
      <fieldset class="questions" disabled={readOnly}>
        {sectionsOf(questionnaire).map(({ section, items }, i) => (
          <section key={i} aria-labelledby={section === '' ? undefined : `section-${i}`}>
            {section !== '' && <h3 id={`section-${i}`}>{section}</h3>}
            {items.map((item) => (
              <Question key={item.id} item={item} sheet={sheet} />
            ))}
          </section>
        ))}
        <div class="questionnaire-end">
          <p class="soft" data-testid="progress">
            {studyText.progress(sheet.answered.value, sheet.requiredItems.length)}
          </p>
          {sheet.tried.value && missing.length > 0 && (
            <p class="message message-bad" role="alert" data-testid="missing">
              {studyText.missing(missing.length)}{' '}
              <button type="button" class="link-button" onClick={() => goToFirstMissing(sheet)}>
                {studyText.toFirstMissing}
              </button>
            </p>
          )}
          {status.value !== null && (
            <div role="status">
              <Message kind={status.value.kind} testId="answers-status">
                {status.value.text}
              </Message>
            </div>
          )}
          <Button submit look="main" testId="send-answers" disabled={busy.value}>
            {busy.value ? studyText.sending : sendLabel}
          </Button>
        </div>
      </fieldset>
    </form>
  );
}

function goToFirstMissing(sheet: AnswerSheet): void {
  const first = sheet.missing.value[0];
  if (first === undefined) return;
  const question = document.getElementById(questionId(first));
  const field = question?.matches('textarea') === true ? question : question?.querySelector('input');
  question?.scrollIntoView({ block: 'center' });
  field?.focus({ preventScroll: true });
}
