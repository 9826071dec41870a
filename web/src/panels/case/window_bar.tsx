import { caseFileText } from '../../text/case_file_text';
import { caseText } from '../../text/case_text';
import { type WindowLevel, windowLimits, windowPresets } from '../../ct/window_level';
import type { CaseController } from '../../state/case/case_controller';
import { CheckField } from '../common/fields';

const presets: readonly (readonly [string, string, WindowLevel])[] = [
  ['bone', caseText.windowBone, windowPresets.bone],
  ['soft', caseText.windowSoft, windowPresets.soft],
];

/** Brightness of the slices and what lies over them. */
export function WindowBar({ controller }: { controller: CaseController }) {
  const { store } = controller;
  const scapula = store.details.value?.segmentation?.parts.find(({ label }) => label === 1);
  const { widthHu, levelHu } = store.window.value;
  const { widthMin, widthMax, levelMin, levelMax } = windowLimits;
  return (
    <section class="window-bar" aria-label={caseFileText.picture}>
      <div class="window-group" role="group" aria-label={caseText.windowGroup}>
        {presets.map(([name, label, preset]) => (
          <button
            type="button"
            key={name}
            class="chip"
            data-testid={`window-${name}`}
            aria-pressed={preset.widthHu === widthHu && preset.levelHu === levelHu}
            onClick={() => (store.window.value = preset)}
          >
            {label}
          </button>
        ))}
        <WindowSlider
          {...{ label: caseText.windowWidth, value: widthHu, low: widthMin, high: widthMax, testId: 'window-width' }}
          onChange={(value) => (store.window.value = { ...store.window.value, widthHu: value })}
        />
        <WindowSlider
          {...{ label: caseText.windowLevel, value: levelHu, low: levelMin, high: levelMax, testId: 'window-level' }}
          onChange={(value) => (store.window.value = { ...store.window.value, levelHu: value })}
        />
      </div>
      {store.details.value?.segmentation && (
        <CheckField
          label={caseText.showLabels}
          checked={store.labelsShown.value}
          testId="show-labels"
          onChange={(shown) => (store.labelsShown.value = shown)}
        />
      )}
      {store.openStep.value === 'segment' && (
        <CheckField
          label={caseText.showPreview}
          checked={store.previewShown.value}
          testId="show-preview"
          onChange={(shown) => (store.previewShown.value = shown)}
        />
      )}
      <div class="window-group framing">
        {scapula !== undefined && (
          <button type="button" class="chip" data-testid="frame-scapula" onClick={() => controller.framePart(scapula)}>
            {caseText.partNames[1]}
          </button>
        )}
        <button type="button" class="chip" data-testid="frame-ct" onClick={() => controller.framePart(null)}>
          {caseText.wholeCt}
        </button>
      </div>
    </section>
  );
}

interface SliderParts {
  label: string;
  value: number;
  low: number;
  high: number;
  testId: string;
  onChange: (value: number) => void;
}

function WindowSlider({ label, value, low, high, testId, onChange }: SliderParts) {
  return (
    <label class="window-slider">
      {label}
      <input
        type="range"
        data-testid={testId}
        {...{ min: low, max: high, step: 10, value }}
        onInput={(event) => onChange(event.currentTarget.valueAsNumber)}
      />
      <output>{value}</output>
    </label>
  );
}
