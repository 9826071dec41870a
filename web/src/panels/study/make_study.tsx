import { useSignal } from '@preact/signals';
import { useMemo } from 'preact/hooks';

import { type QuestionnaireChoice, StudyDraft } from '../../state/study/study_draft';
import { feelText } from '../../text/feel_text';
import { questionnaireText } from '../../text/questionnaire_text';
import { studyText } from '../../text/study_text';
import { CaseApi } from '../../wire/case_api';
import { messageOf } from '../../wire/rest';
import type { StudyApi } from '../../wire/study_api';
import { Message } from '../common/fields';
import { Choice, TextLine } from '../common/form_fields';
import { useRemote } from '../common/use_remote';
import { useUnsavedGuard } from '../common/use_unsaved_guard';
import { Button } from '../common/button';
import { DesignFields } from './design_fields';
import { FeelFields } from './feel_fields';
import { QuestionnaireEditor } from './questionnaire_editor';
import { QuestionnairePreview } from './questionnaire_preview';
import { SampleSizeHelp } from './sample_size_help';

/** The form for another study. */
export function MakeStudy({ api, onMade }: { api: StudyApi; onMade: (studyId: string) => void }) {
  const draft = useMemo(() => new StudyDraft(), []);
  const previewed = useSignal(false);
  const made = useSignal(false);
  useUnsavedGuard(draft, ({ questionnaireWritten }) => !made.peek() && questionnaireWritten, questionnaireText.leave);
  const make = async (event: Event) => {
    event.preventDefault();
    draft.problem.value = null;
    try {
      const { id } = await api.make(draft.study());
      made.value = true;
      onMade(id);
    } catch (error) {
      draft.problem.value = messageOf(error);
    }
  };
  return (
    <section class="content-panel" aria-labelledby="make-title">
      <h2 id="make-title">{studyText.make}</h2>
      <SampleSizeHelp api={api} />
      <form class="content-form" onSubmit={(event) => void make(event)}>
        <TextLine
          {...{ label: studyText.name, testId: 'study-name', required: true, maxLength: 200, value: draft.name.value }}
          onInput={(name) => (draft.name.value = name)}
        />
        <Choice
          {...{ label: feelText.kind, testId: 'study-kind', value: draft.feel.used.value ? 'feel' : 'scores' }}
          options={feelText.kinds}
          onChange={(kind) => (draft.feel.used.value = kind === 'feel')}
        />
        <Choice
          {...{
            label: studyText.device,
            testId: 'study-device',
            value: draft.device.value,
            options: studyText.devices,
          }}
          onChange={(device) => (draft.device.value = device)}
        />
        <QuestionnaireFields draft={draft} onPreview={() => (previewed.value = true)} />
        {draft.feel.used.value ? <FeelFields draft={draft.feel} /> : <DesignAndRaters draft={draft} />}
        <DescriptionField draft={draft} />
        {!draft.feel.used.value && <CaseFields draft={draft} />}
        <Button submit look="main" testId="make-study" disabled={!draft.complete}>
          {studyText.makeButton}
        </Button>
      </form>
      {previewed.value && (
        <QuestionnairePreview
          questionnaire={draft.questionnaire.questionnaire.value}
          close={() => (previewed.value = false)}
        />
      )}
      {draft.problem.value !== null && (
        <Message kind="bad" testId="make-problem">
          {draft.problem.value}
        </Message>
      )}
    </section>
  );
}

function DesignAndRaters({ draft }: { draft: StudyDraft }) {
  return (
    <>
      <Choice
        {...{ label: studyText.ratingForm, testId: 'study-rating-form', value: draft.rated.value ? 'ours' : '' }}
        options={[
          ['ours', studyText.ownRatingForm],
          ['', studyText.noRatingForm],
        ]}
        onChange={(chosen) => (draft.rated.value = chosen !== '')}
      />
      <DesignFields draft={draft.design} />
    </>
  );
}

const questionnaires: readonly (readonly [QuestionnaireChoice, string])[] = [
  ['ours', studyText.ownQuestionnaire],
  ['none', studyText.noQuestionnaire],
  ['own', studyText.otherQuestionnaire],
];

function QuestionnaireFields({ draft, onPreview }: { draft: StudyDraft; onPreview: () => void }) {
  return (
    <>
      <Choice
        {...{ label: studyText.questionnaire, testId: 'study-questionnaire', value: draft.questionnaireChoice.value }}
        options={questionnaires}
        onChange={(value) => (draft.questionnaireChoice.value = value as QuestionnaireChoice)}
      />
      {draft.questionnaireChoice.value === 'own' && (
        <QuestionnaireEditor
          draft={draft.questionnaire}
          read={(file) => void draft.readQuestionnaire(file)}
          onPreview={onPreview}
        />
      )}
    </>
  );
}

function DescriptionField({ draft }: { draft: StudyDraft }) {
  return (
    <label class="wide">
      {studyText.description}
      <textarea
        rows={2}
        maxLength={4000}
        data-testid="study-description"
        value={draft.description.value}
        onInput={(event) => (draft.description.value = event.currentTarget.value)}
      />
    </label>
  );
}

/** The cases that can be reamed; a session of the study is on one of those chosen. */
function CaseFields({ draft }: { draft: StudyDraft }) {
  const cases = useRemote(() => new CaseApi(window.location.origin).cases());
  const usable = cases.value.value?.filter((one) => one.stage === 'built' && one.planned) ?? [];
  return (
    <fieldset class="wide">
      <legend>{studyText.cases}</legend>
      {cases.value.value !== null && usable.length === 0 && <span class="soft">{studyText.noCases}</span>}
      {usable.map((one) => (
        <label class="check" key={one.id}>
          <input
            type="checkbox"
            data-testid={`study-case-${one.id}`}
            checked={draft.cases.value.includes(one.id)}
            onChange={() => draft.toggleCase(one.id)}
          />
          {one.name || one.id}
        </label>
      ))}
    </fieldset>
  );
}
