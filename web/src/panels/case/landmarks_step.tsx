import { caseFileText } from '../../text/case_file_text';
import { caseText } from '../../text/case_text';
import { fixed } from '../../text/format';
import type { CaseController } from '../../state/case/case_controller';
import {
  biconcavityNames,
  headRadiusLimitsMm,
  isOptional,
  landmarkNames,
  type LandmarkName,
  pointOf,
} from '../../state/case/landmark_names';
import { checkCentre, farFromMiddleMm } from '../../state/case/rim_check';
import type { SaveState } from '../../state/case/landmark_editor';
import { type WalchClass, walchClasses } from '../../wire/rest_types';
import { Message, SelectField, SliderField } from '../common/fields';
import { MeasuresPanel } from './measures_panel';
import { Button } from '../common/button';

/** The landmarks to be placed, the head's radius, the Walch class, and what is measured from them. */
export function LandmarksStep({ controller }: { controller: CaseController }) {
  const armed = controller.store.armed.value;
  const landmarks = controller.landmarks.landmarks.value;
  const head = landmarks.humeral_head;
  const chosen = armed?.kind === 'landmark' ? armed.name : null;
  const { low, high } = headRadiusLimitsMm;
  return (
    <>
      <p class="soft landmark-hint">{chosen === null ? caseText.landmarksHint : caseText.landmarkHints[chosen]}</p>
      <ol class="pick-list landmarks">
        {landmarkNames
          .filter((name) => !isOptional(name))
          .map((name) => (
            <LandmarkRow key={name} {...{ controller, name, chosen: name === chosen }} />
          ))}
      </ol>
      {head !== undefined && (
        <SliderField
          {...{ label: caseText.headRadius, unit: caseText.mm, value: head.radius_mm, low, high, step: 0.5 }}
          testId="head-radius"
          onChange={(radius_mm) => controller.landmarks.change({ ...landmarks, humeral_head: { ...head, radius_mm } })}
        />
      )}
      <SelectField<WalchClass | ''>
        label={caseText.walch}
        value={landmarks.walch ?? ''}
        options={[
          ['', caseText.walchNone] as const,
          ...walchClasses.map((name) => [name, `${name}: ${caseText.walchHints[name]}`] as const),
        ]}
        testId="walch"
        onChange={(walch) => {
          const { walch: before, ...others } = landmarks;
          if (walch !== (before ?? '')) controller.landmarks.change(walch === '' ? others : { ...others, walch });
        }}
      />
      <Biconcavity controller={controller} chosen={chosen} />
      <CentreCheck controller={controller} />
      <SaveLine controller={controller} state={controller.landmarks.save.value} />
      <MeasuresPanel controller={controller.landmarks} />
    </>
  );
}

/** The points of a biconcave face, open where the class says so or one is placed. */
function Biconcavity({ controller, chosen }: { controller: CaseController; chosen: LandmarkName | null }) {
  const landmarks = controller.landmarks.landmarks.value;
  const named = landmarks.walch === 'B2' || landmarks.walch === 'C2';
  const begun = biconcavityNames.some((name) => name === chosen || pointOf(landmarks, name) !== null);
  return (
    <details class="seeds" open={named || begun} data-testid="biconcavity">
      <summary>{caseText.biconcavity}</summary>
      <p class="soft">{caseText.biconcavityHint}</p>
      <ol class="pick-list landmarks">
        {biconcavityNames.map((name) => (
          <LandmarkRow key={name} {...{ controller, name, chosen: name === chosen }} />
        ))}
      </ol>
    </details>
  );
}

interface RowParts {
  controller: CaseController;
  name: LandmarkName;
  chosen: boolean;
}

function LandmarkRow({ controller, name, chosen }: RowParts) {
  const isPlaced = pointOf(controller.landmarks.landmarks.value, name) !== null;
  const title = caseText.landmarkNames[name];
  return (
    <li>
      <button
        type="button"
        class="pick"
        data-testid={`landmark-${name}`}
        data-placed={isPlaced}
        aria-pressed={chosen}
        title={caseText.landmarkHints[name]}
        onClick={() => (chosen ? (controller.store.armed.value = null) : controller.choose(name))}
      >
        <kbd>{landmarkNames.indexOf(name) + 1}</kbd>
        {title}
        <span class={isPlaced ? 'pick-state good' : 'pick-state soft'}>
          {isPlaced ? '✓' : ''}
          <span class="visually-hidden">{isPlaced ? caseText.placed : caseText.notPlaced}</span>
        </span>
      </button>
      {isPlaced && (
        <button
          type="button"
          class="remove"
          data-testid={`remove-${name}`}
          aria-label={caseText.removeLandmark(title)}
          title={caseText.removeLandmark(title)}
          onClick={() => controller.place(name, null)}
        >
          ×
        </button>
      )}
    </li>
  );
}

/** A centre far from the rim's middle is said, with the way to mend it. */
function CentreCheck({ controller }: { controller: CaseController }) {
  const check = checkCentre(controller.landmarks.landmarks.value);
  if (check === null || check.offMm <= farFromMiddleMm) return null;
  return (
    <div role="status">
      <Message kind="warn" testId="centre-off">
        {caseFileText.centreOff(fixed(check.offMm, 1))}{' '}
        <button
          type="button"
          class="link-button"
          data-testid="use-middle"
          onClick={() => controller.place('glenoid_centre_mm', check.middle)}
        >
          {caseFileText.useMiddle}
        </button>
      </Message>
    </div>
  );
}

/** Whether the server has what is shown; nothing while nothing was changed. */
function SaveLine({ controller, state }: { controller: CaseController; state: SaveState }) {
  const { landmarks } = controller;
  return (
    <div
      class={`save save-${state.kind}`}
      role={isBad(state) ? 'alert' : 'status'}
      data-testid="save"
      data-state={state.kind}
    >
      {state.kind === 'saved' && landmarks.hasSaved.value && caseText.saved}
      {state.kind === 'saving' && caseText.saving}
      {state.kind === 'unsaved' && caseText.unsaved}
      {state.kind === 'failed' && (
        <>
          {caseText.saveFailed(state.message)}
          <Button testId="save-again" onClick={() => void landmarks.saveNow()}>
            {caseText.saveAgain}
          </Button>
        </>
      )}
      {state.kind === 'conflict' && (
        <>
          {caseText.conflict}
          <Button testId="keep-mine" onClick={() => void landmarks.keepMine()}>
            {caseText.keepMine}
          </Button>
          <Button testId="take-theirs" onClick={() => landmarks.takeTheirs()}>
            {caseText.takeTheirs}
          </Button>
        </>
      )}
    </div>
  );
}

const isBad = (state: SaveState) => state.kind === 'failed' || state.kind === 'conflict';
