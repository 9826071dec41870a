import { useEffect, useMemo, useRef } from 'preact/hooks';

import { AnswerSheet } from '../../state/study/answer_sheet';
import { questionnaireText as text } from '../../text/questionnaire_text';
import type { Questionnaire } from '../../wire/rest_types';
import { Button } from '../common/button';
import { AnswerForm } from './answer_form';

const forgetful = { getItem: () => null, setItem: () => undefined, removeItem: () => undefined };

/** A questionnaire as its participants see it, over the page; what is answered is forgotten. */
export function QuestionnairePreview({ questionnaire, close }: { questionnaire: Questionnaire; close: () => void }) {
  const sheet = useMemo(() => new AnswerSheet(questionnaire, forgetful, '', null), [questionnaire]);
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => dialog.current?.showModal(), []);
  return (
    <dialog
      ref={dialog}
      class="preview-dialog"
      aria-label={text.previewTitle}
      data-testid="questionnaire-preview"
      onClose={close}
    >
      <div class="content-head">
        <p class="soft">{text.previewHint}</p>
        <Button testId="close-preview" onClick={() => dialog.current?.close()}>
          {text.close}
        </Button>
      </div>
      <div class="questionnaire">
        <AnswerForm
          {...{ sheet, about: '', thanks: text.tried, sendLabel: text.send, readOnly: false }}
          send={() => Promise.resolve()}
        />
      </div>
    </dialog>
  );
}
