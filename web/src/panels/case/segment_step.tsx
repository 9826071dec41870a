import { caseFileText } from '../../text/case_file_text';
import { caseText } from '../../text/case_text';
import { cssColour } from '../../ct/palette';
import { type CaseController, settingsOf } from '../../state/case/case_controller';
import { lacksShoulder } from '../../state/case/case_steps';
import { isUnderWay } from '../../state/case/job_watch';
import { addressOfRoute } from '../../state/route';
import { seedNames } from '../../state/case/view_marks';
import type { CaseCt, SeedName, CaseSegmentation, FullSegmentationSettings } from '../../wire/rest_types';
import { fixed, sentence } from '../../text/format';
import { CheckField, Message, SliderField } from '../common/fields';
import { Button } from '../common/button';

/** Threshold, smoothing, joints and seeds; finding the bones, and what was found. */
export function SegmentStep({ controller }: { controller: CaseController }) {
  const { store } = controller;
  const details = store.details.value;
  const settings = store.settings.value;
  const ct = details?.ct ?? null;
  if (settings === null || ct === null) return <Message kind="soft">{caseText.noCt}</Message>;
  const found = details?.segmentation ?? null;
  const blocked = store.busy.value || isUnderWay(store.job.value);
  const change = (part: Partial<FullSegmentationSettings>) => (store.settings.value = { ...settings, ...part });
  return (
    <>
      <p class="soft">{caseText.segmentHint}</p>
      <ThresholdField ct={ct} value={settings.threshold_hu} onChange={(threshold_hu) => change({ threshold_hu })} />
      <SliderField
        {...{ label: caseText.smoothing, unit: caseText.mm, value: settings.sigma_mm, low: 0, high: 2, step: 0.1 }}
        testId="sigma"
        onChange={(sigma_mm) => change({ sigma_mm })}
      />
      <CheckField
        label={caseText.separate}
        hint={caseText.separateHint}
        checked={settings.separate}
        testId="separate"
        onChange={(separate) => change({ separate })}
      />
      <CheckField
        label={caseText.fillHoles}
        checked={settings.fill_holes}
        testId="fill-holes"
        onChange={(fill_holes) => change({ fill_holes })}
      />
      <SeedList controller={controller} settings={settings} />
      <div class="buttons">
        <Button
          look="main"
          testId="run-segmentation"
          disabled={blocked}
          onClick={() => void controller.segment(settings)}
        >
          {found === null ? caseText.runSegment : caseText.runSegmentAgain}
        </Button>
        <Button
          testId="undo-segmentation"
          disabled={blocked || found?.can_undo !== true}
          onClick={() => void controller.undoSegmentation()}
        >
          {caseText.undo}
        </Button>
      </div>
      {found !== null && !sameSettings(settingsOf(ct, found), settings) && (
        <Message kind="warn" testId="settings-changed">
          {caseText.settingsChanged}
        </Message>
      )}
      {found !== null && <PartList controller={controller} found={found} />}
      <details class="seeds">
        <summary>{caseText.otherSide}</summary>
        <p class="soft">{caseText.otherSideHint}</p>
        <Button testId="copy-other-side" disabled={blocked} onClick={() => void openOtherSide(controller)}>
          {caseText.copyOtherSide(details?.side === 'left' ? 'right' : 'left')}
        </Button>
      </details>
    </>
  );
}

async function openOtherSide(controller: CaseController): Promise<void> {
  const id = await controller.copyForOtherSide();
  if (id !== null) window.location.hash = addressOfRoute({ kind: 'case', id });
}

function ThresholdField({ ct, value, onChange }: { ct: CaseCt; value: number; onChange: (hu: number) => void }) {
  const suggested = Math.round(ct.suggested_threshold_hu);
  const low = Math.max(Math.ceil(ct.hu_min), -200);
  const high = Math.max(Math.min(Math.floor(ct.hu_max), 1200), low + 1);
  return (
    <>
      <SliderField
        {...{ label: caseText.threshold, unit: caseText.hu, value, low, high, step: 1, mark: suggested }}
        testId="threshold"
        onChange={onChange}
      />
      <p class="soft suggestion" data-testid="suggested">
        {caseText.suggested(fixed(suggested, 0))}
        {Math.abs(value - suggested) > 0.5 && (
          <button type="button" class="link-button" data-testid="use-suggested" onClick={() => onChange(suggested)}>
            {caseText.useSuggested}
          </button>
        )}
      </p>
    </>
  );
}

function SeedList({ controller, settings }: { controller: CaseController; settings: FullSegmentationSettings }) {
  const { store } = controller;
  const armed = store.armed.value;
  const remove = (name: SeedName) => {
    const seeds = { ...settings.seeds };
    delete seeds[name];
    store.settings.value = { ...settings, seeds };
  };
  return (
    <details class="seeds" open={Object.keys(settings.seeds).length > 0}>
      <summary>{caseText.seeds}</summary>
      <p class="soft">{caseText.seedsHint}</p>
      <ul class="pick-list">
        {seedNames.map((name, i) => {
          const isArmed = armed?.kind === 'seed' && armed.name === name;
          const seed = settings.seeds[name];
          return (
            <li key={name}>
              <button
                type="button"
                class="pick"
                data-testid={`seed-${name}`}
                aria-pressed={isArmed}
                onClick={() => (store.armed.value = isArmed ? null : { kind: 'seed', name })}
              >
                <span class="swatch" style={{ background: cssColour(i + 1) }} aria-hidden="true" />
                {caseText.seedNames[name]}
                <span class="soft pick-state">{seed === undefined ? caseText.seedNone : caseText.seedSet}</span>
              </button>
              {seed !== undefined && (
                <button
                  type="button"
                  class="remove"
                  aria-label={caseText.removeSeed(caseText.seedNames[name])}
                  onClick={() => remove(name)}
                >
                  ×
                </button>
              )}
            </li>
          );
        })}
      </ul>
    </details>
  );
}

function PartList({ controller, found }: { controller: CaseController; found: CaseSegmentation }) {
  return (
    <>
      <h3>{caseText.parts}</h3>
      <ul class="part-list" data-testid="parts">
        {found.parts.map((part) => {
          const name = caseText.partNames[part.label] ?? part.name;
          return (
            <li key={part.label}>
              <button
                type="button"
                class="pick"
                data-testid={`part-${part.label}`}
                aria-label={caseText.goToPart(name)}
                onClick={() => {
                  controller.lookAt(part.centre_mm);
                  controller.framePart(part);
                }}
              >
                <span class="swatch" style={{ background: cssColour(part.label) }} aria-hidden="true" />
                {name}
                <span class="pick-state">{caseText.volume(fixed(part.volume_mm3 / 1000, 1))}</span>
              </button>
            </li>
          );
        })}
      </ul>
      {lacksShoulder(found) && (
        <Message kind="bad" testId="no-shoulder">
          <strong>{caseFileText.noShoulder}</strong> {caseFileText.noShoulderHint}
        </Message>
      )}
      {found.warnings.map((warning) => (
        <Message kind="warn" key={warning}>
          {sentence(warning)}
        </Message>
      ))}
    </>
  );
}

function sameSettings(a: FullSegmentationSettings, b: FullSegmentationSettings): boolean {
  return (
    Math.abs(a.threshold_hu - b.threshold_hu) < 0.5 &&
    Math.abs(a.sigma_mm - b.sigma_mm) < 1e-6 &&
    a.separate === b.separate &&
    a.fill_holes === b.fill_holes &&
    seedNames.every((name) => (a.seeds[name] ?? []).join() === (b.seeds[name] ?? []).join())
  );
}
