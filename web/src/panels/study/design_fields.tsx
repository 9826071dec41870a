import { type ArmDraft, type DesignDraft, maxArms } from '../../state/study/design_draft';
import { studyText } from '../../text/study_text';
import { Button } from '../common/button';
import { Check, Choice, Count, TextLine } from '../common/form_fields';

const most = { sessions: 20, training: 1000, days: 1000 };

/** Whether a study has tests and arms, and which. */
export function DesignFields({ draft }: { draft: DesignDraft }) {
  return (
    <>
      <Choice
        {...{ label: studyText.design, testId: 'study-design', value: draft.used.value ? 'arms' : '' }}
        options={[
          ['', studyText.noDesign],
          ['arms', studyText.armsDesign],
        ]}
        onChange={(chosen) => (draft.used.value = chosen !== '')}
      />
      {draft.used.value && <Tests draft={draft} />}
      {draft.used.value && <Arms draft={draft} />}
    </>
  );
}

const countsOf = (draft: DesignDraft) =>
  [
    ['pre', studyText.preSessions, draft.preSessions, 0, most.sessions],
    ['post', studyText.postSessions, draft.postSessions, 0, most.sessions],
    ['retention', studyText.retentionSessions, draft.retentionSessions, 0, most.sessions],
    ['days', studyText.retentionDays, draft.retentionAfterDays, 1, most.days],
  ] as const;

function Tests({ draft }: { draft: DesignDraft }) {
  return (
    <fieldset class="wide">
      <legend>{studyText.tests}</legend>
      <p class="soft">{studyText.testsHint}</p>
      <div class="content-form">
        {countsOf(draft).map(([name, label, count, min, max]) => (
          <Count
            key={name}
            {...{ label, testId: `design-${name}`, value: count.value, min, max }}
            onChange={(value) => (count.value = value)}
          />
        ))}
        <Check
          {...{ label: studyText.testTheatre, testId: 'design-theatre', checked: draft.testTheatre.value }}
          onChange={(theatre) => (draft.testTheatre.value = theatre)}
        />
      </div>
    </fieldset>
  );
}

function Arms({ draft }: { draft: DesignDraft }) {
  const arms = draft.arms.value;
  return (
    <fieldset class="wide">
      <legend>{studyText.arms}</legend>
      <p class="soft">{studyText.armsHint}</p>
      {arms.map((arm, i) => (
        <ArmFields key={i} {...{ draft, arm, place: i, number: i + 1, only: arms.length === 1 }} />
      ))}
      {arms.length < maxArms && (
        <Button testId="add-arm" onClick={() => draft.add()}>
          {studyText.addArm}
        </Button>
      )}
    </fieldset>
  );
}

interface ArmParts {
  draft: DesignDraft;
  arm: ArmDraft;
  place: number;
  /** For people: from 1. */
  number: number;
  only: boolean;
}

function ArmFields({ draft, arm, place, number, only }: ArmParts) {
  return (
    <div class="content-form" role="group" aria-label={studyText.armNumber(number)}>
      <TextLine
        {...{ label: studyText.armName, testId: `arm-name-${number}`, required: true, maxLength: 200, value: arm.name }}
        onInput={(name) => draft.change(place, { name })}
      />
      <Count
        {...{ label: studyText.trainingSessions, testId: `arm-sessions-${number}`, value: arm.trainingSessions }}
        min={0}
        max={most.training}
        onChange={(trainingSessions) => draft.change(place, { trainingSessions })}
      />
      <Check
        {...{ label: studyText.armTheatre, testId: `arm-theatre-${number}`, checked: arm.theatre }}
        onChange={(theatre) => draft.change(place, { theatre })}
      />
      {!only && (
        <Button testId={`remove-arm-${number}`} onClick={() => draft.remove(place)}>
          {studyText.removeArm(number)}
        </Button>
      )}
    </div>
  );
}
