import { useEffect, useMemo } from 'preact/hooks';

import { PageHeader } from '../panels/common/page_header';
import { Message } from '../panels/common/fields';
import { AnswerForm } from '../panels/study/answer_form';
import { Remote } from '../state/remote';
import { addressOfRoute } from '../state/route';
import { AnswerSheet } from '../state/study/answer_sheet';
import { studyText } from '../text/study_text';
import type { StudyApi } from '../wire/study_api';

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
            <AnswerForm
              sheet={loaded.sheet}
              about={studyText.asCode(code)}
              thanks={studyText.sent}
              sendLabel={studyText.send}
              readOnly={loaded.theirs || loaded.study.state === 'closed'}
              send={(kept) => api.answer(studyId, code, kept.answers.value)}
            />
          )}
        </section>
      </main>
    </div>
  );
}
