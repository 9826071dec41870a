import { useSignal } from '@preact/signals';
import { useEffect, useMemo } from 'preact/hooks';

import { PageHeader } from '../panels/common/page_header';
import { Message } from '../panels/common/fields';
import { Question, questionId } from '../panels/study/question';
import { Remote } from '../state/remote';
import { addressOfRoute } from '../state/route';
import { AnswerSheet, sectionsOf } from '../state/study/answer_sheet';
import { studyText } from '../text/study_text';
import { messageOf } from '../wire/rest';
import type { StudyApi } from '../wire/study_api';
import { Button } from '../panels/common/button';

interface Parts {
  api: StudyApi;
  studyId: string;
  code: string;
}

/** What a study asks one of its participants. */
export function QuestionnairePage({ api, studyId, code }: Parts) {
  const sheet = useMemo(
    () =>
      new Remote(async () => {
        const [study, participant] = await Promise.all([api.study(studyId), api.participant(studyId, code)]);
        const { questionnaire } = study;
        const theirs = participant.has_account && study.participant !== code;
        if (!questionnaire) return { study, sheet: null, theirs };
        const key = `ream.answers.${studyId}.${code}`;
        return {
          study,
          theirs,
          sheet: new AnswerSheet(questionnaire, window.sessionStorage, key, participant.answers),
        };
      }),
    [api, studyId, code],
  );
  useEffect(() => void sheet.read(), [sheet]);
  const loaded = sheet.value.value;
  const back = addressOfRoute({ kind: 'study', id: studyId });
  return (
    <div class="page content-page">
      <PageHeader here="questionnaire" />
      <main class="content">
        <section class="content-panel questionnaire">
          <p>
            <a href={back} data-testid="back-to-study">
              ‹ {loaded?.study.name ?? studyText.backToStudy}
            </a>
          </p>
          {sheet.problem.value !== null && <Message kind="bad">{sheet.problem.value}</Message>}
          {loaded === null && sheet.problem.value === null && <p class="soft">{studyText.loading}</p>}
          {loaded?.sheet === null && <p>{studyText.noQuestions}</p>}
          {loaded?.study.state === 'closed' && <Message kind="warn">{studyText.closedHint}</Message>}
          {loaded?.theirs && <Message kind="warn">{studyText.theirAnswers}</Message>}
          {loaded?.sheet && (
            <Sheet
              sheet={loaded.sheet}
              code={code}
              readOnly={loaded.theirs || loaded.study.state === 'closed'}
              send={(kept) => api.answer(studyId, code, kept.answers.value)}
            />
          )}
        </section>
      </main>
    </div>
  );
}

interface SheetParts {
  sheet: AnswerSheet;
  code: string;
  readOnly: boolean;
  send: (sheet: AnswerSheet) => Promise<unknown>;
}

function Sheet({ sheet, code, readOnly, send }: SheetParts) {
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
      status.value = { kind: 'soft', text: studyText.sent };
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
        {questionnaire.introduction} {studyText.asCode(code)}
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
            {busy.value ? studyText.sending : studyText.send}
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
