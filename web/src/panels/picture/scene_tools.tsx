import '../../styles/scene_tools.css';

import { type ReadonlySignal, signal } from '@preact/signals';
import { useMemo } from 'preact/hooks';

import { liveText } from '../../text/live_text';
import {
  opacityLeast,
  type PictureLevel,
  sectionNames,
  sectionReachMm,
  type SectionName,
  pictureChoices,
  type ViewSettings,
} from '../../state/view_settings';
import { contactColour, kindColours } from '../../scene/bone_paint';
import { fixed } from '../../text/format';
import { useLiveKeys } from './live_keys';
import { ViewToggle } from '../common/view_toggle';

/** One press of a key that moves a section, mm. */
const keyStepMm = 1;
const open = signal(false);
/** The section that the keys move. */
const keyed = signal<SectionName>('axial');

interface Parts {
  view: ViewSettings;
  /** How much is drawn now. */
  level: ReadonlySignal<PictureLevel>;
}

/** What the picture shows: the camera, and how the bone is seen. All of it also by keys. */
export function SceneTools({ view, level }: Parts) {
  const keys = useMemo(
    () => Object.fromEntries(Object.entries(actions).map(([key, action]) => [key, () => action(view)])),
    [view],
  );
  useLiveKeys(keys);
  const { cutAway, boneKinds, seeThrough, sections } = view.choices.value;
  const cut = sectionNames.some((name) => sections[name].on);
  return (
    <>
      <ViewToggle
        id="trainee-camera"
        letter="V"
        on={view.camera.value === 'trainee'}
        hint={liveText.traineeCameraHint}
        onToggle={() => actions.v?.(view)}
      >
        {liveText.traineeCamera}
      </ViewToggle>
      <ViewToggle id="cut-away" letter="C" on={cutAway} hint={liveText.cutAwayHint} onToggle={() => actions.c?.(view)}>
        {liveText.cutAway}
      </ViewToggle>
      <ViewToggle
        id="see-through"
        letter="X"
        on={seeThrough}
        hint={liveText.seeThroughHint}
        onToggle={() => actions.x?.(view)}
      >
        {liveText.seeThrough}
      </ViewToggle>
      <ViewToggle
        id="bone-kinds"
        letter="K"
        on={boneKinds}
        hint={liveText.boneKindsHint}
        onToggle={() => actions.k?.(view)}
      >
        {liveText.boneKinds}
      </ViewToggle>
      <button
        type="button"
        class={cut ? 'tool-on' : ''}
        data-testid="sections"
        aria-expanded={open.value}
        aria-controls="sections-panel"
        title={liveText.sectionsHint}
        onClick={() => (open.value = !open.value)}
      >
        {liveText.sections}
      </button>
      {open.value && <SectionsPanel view={view} level={level} />}
      {boneKinds && !open.value && <KindsLegend />}
    </>
  );
}

/** What the colours of the bone say. */
function KindsLegend() {
  const rows: [string, string][] = [
    [liveText.kind.cortical, kindColours.cortical],
    [liveText.kind.cancellous, kindColours.cancellous],
    [liveText.kind.cartilage, kindColours.cartilage],
    [liveText.contact, contactColour],
  ];
  return (
    <ul class="kinds-legend" data-testid="kinds-legend">
      {rows.map(([name, colour]) => (
        <li key={name}>
          <span class="kind-swatch" style={{ background: colour }} aria-hidden="true" /> {name}
        </li>
      ))}
    </ul>
  );
}

function SectionsPanel({ view, level }: Parts) {
  const { opacity, seeThrough } = view.choices.value;
  const percent = fixed(opacity * 100, 0);
  return (
    <div
      class="sections-panel"
      id="sections-panel"
      role="group"
      aria-label={liveText.sections}
      data-testid="sections-panel"
      onKeyDown={(event) => {
        if (event.key !== 'Escape') return;
        // Nothing else ends by the same press.
        event.preventDefault();
        open.value = false;
      }}
    >
      <label class="section-row">
        <span>{liveText.boneOpacity}</span>
        <input
          type="range"
          data-testid="bone-opacity"
          min={opacityLeast * 100}
          max={100}
          step={5}
          value={seeThrough ? opacity * 100 : 100}
          aria-valuetext={liveText.opacityValue(percent)}
          onInput={(event) => {
            const share = event.currentTarget.valueAsNumber / 100;
            view.change({ opacity: share, seeThrough: share < 1 });
          }}
        />
        <output>{seeThrough ? percent : '100'} %</output>
      </label>
      {sectionNames.map((name, i) => (
        <SectionRow key={name} view={view} name={name} letter={String(i + 1)} />
      ))}
      <PictureRow view={view} level={level} />
    </div>
  );
}

function SectionRow({ view, name, letter }: { view: ViewSettings; name: SectionName; letter: string }) {
  const { on, offsetMm, flipped } = view.choices.value.sections[name];
  const label = liveText.section[name];
  return (
    <div class="section-row">
      <label class="section-name">
        <input
          type="checkbox"
          data-testid={`section-${name}`}
          checked={on}
          aria-keyshortcuts={letter}
          title={liveText.key(liveText.sectionCuts[name](flipped), letter)}
          onChange={(event) => {
            keyed.value = name;
            view.changeSection(name, { on: event.currentTarget.checked });
          }}
        />
        {label}
      </label>
      <input
        type="range"
        data-testid={`section-${name}-offset`}
        aria-label={liveText.sectionOffset(label)}
        aria-valuetext={liveText.millimetres(fixed(offsetMm, 1))}
        min={-sectionReachMm}
        max={sectionReachMm}
        step={0.5}
        value={offsetMm}
        onInput={(event) => {
          keyed.value = name;
          view.changeSection(name, { on: true, offsetMm: event.currentTarget.valueAsNumber });
        }}
      />
      <output>{liveText.millimetres(fixed(offsetMm, 1))}</output>
      <button
        type="button"
        class="section-flip"
        data-testid={`section-${name}-flip`}
        aria-label={liveText.otherSideOf(label)}
        aria-pressed={flipped}
        title={liveText.sectionCuts[name](!flipped)}
        onClick={() => view.changeSection(name, { flipped: !flipped })}
      >
        ⇅
      </button>
    </div>
  );
}

/** How much is drawn, and what `automatic` has come to. */
function PictureRow({ view, level }: Parts) {
  const chosen = view.choices.value.toolDrawing;
  return (
    <label class="section-row tool-drawing" title={liveText.toolDrawingHint}>
      <span>{liveText.toolDrawing}</span>
      <select
        data-testid="tool-drawing"
        value={chosen}
        onChange={(event) => {
          const { value } = event.currentTarget;
          const toolDrawing = pictureChoices.find((one) => one === value);
          if (toolDrawing !== undefined) view.change({ toolDrawing });
        }}
      >
        {pictureChoices.map((one) => (
          <option key={one} value={one}>
            {one === 'automatic' && chosen === one
              ? liveText.toolDrawnNow(liveText.toolDrawingNamed[level.value].toLowerCase())
              : liveText.toolDrawingNamed[one]}
          </option>
        ))}
      </select>
    </label>
  );
}

const toggleSection = (view: ViewSettings, name: SectionName) => {
  keyed.value = name;
  view.changeSection(name, { on: !view.choices.value.sections[name].on });
};
const moveSection = (view: ViewSettings, byMm: number) => {
  const section = view.choices.value.sections[keyed.value];
  view.changeSection(keyed.value, { on: true, offsetMm: section.offsetMm + byMm });
};

/** By key; none of them is one of the practising hand's. */
const actions: Record<string, (view: ViewSettings) => void> = {
  v: (view) => view.change({ camera: view.camera.value === 'own' ? 'trainee' : 'own' }),
  c: (view) => view.change({ cutAway: !view.choices.value.cutAway }),
  k: (view) => view.change({ boneKinds: !view.choices.value.boneKinds }),
  x: (view) => view.change({ seeThrough: !view.choices.value.seeThrough }),
  '1': (view) => toggleSection(view, 'axial'),
  '2': (view) => toggleSection(view, 'coronal'),
  '3': (view) => toggleSection(view, 'sagittal'),
  '[': (view) => moveSection(view, -keyStepMm),
  ']': (view) => moveSection(view, keyStepMm),
};
