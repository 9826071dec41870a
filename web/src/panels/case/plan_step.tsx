import { signal } from '@preact/signals';
import { useState } from 'preact/hooks';

import { caseText } from '../../text/case_text';
import type { CaseController } from '../../state/case/case_controller';
import { neededNames, pointOf } from '../../state/case/landmark_names';
import type { Guide, PlanTargets, Reamer } from '../../wire/rest_types';
import { CheckField, NumberBox, NumberField, Message, SelectField } from '../common/fields';
import { PlanDraftPanel } from './plan_draft_panel';
import { reamerText } from './reamer_text';
import { Button } from '../common/button';

/** Components whose pegs or keels scoring knows. */
const implantNames = [
  'pegged small',
  'pegged medium',
  'pegged large',
  'keeled small',
  'keeled medium',
  'keeled large',
] as const;
type ImplantName = (typeof implantNames)[number];

/** Targets of the plan (null: the server chooses); they last as long as the page is open. */
export class PlanTargetsStore {
  readonly versionDeg = signal<number | null>(0);
  /** Null: as it is, within 10 degrees. */
  readonly inclinationDeg = signal<number | null>(null);
  readonly depthMm = signal(2);
  /** Null: as the reamer. */
  readonly implantRadiusMm = signal<number | null>(null);
  /** Whose pegs or keel are scored; null: usual pegs. */
  readonly implant = signal<ImplantName | null>(null);
  /** A name in the library; null: the one that fits the implant. */
  readonly reamer = signal<string | null>(null);
  /** Null: as the reamer needs it. */
  readonly pilot = signal<{ diameterMm: number; depthMm: number } | null>(null);
  readonly guide = signal<Guide | null>(null);

  request(): PlanTargets {
    const pilot = this.pilot.value;
    const all = {
      version_deg: this.versionDeg.value,
      inclination_deg: this.inclinationDeg.value,
      depth_mm: this.depthMm.value,
      implant_radius_mm: this.implantRadiusMm.value,
      implant_size: this.implant.value,
      reamer: this.reamer.value,
      guide: this.guide.value,
      pilot_diameter_mm: pilot?.diameterMm ?? null,
      pilot_depth_mm: pilot?.depthMm ?? null,
    };
    return Object.fromEntries(Object.entries(all).filter(([, value]) => value !== null));
  }
}

/** A proposal from targets, the plan by numbers, and keeping it. */
export function PlanStep({ controller, targets }: { controller: CaseController; targets: PlanTargetsStore }) {
  const { store } = controller;
  const landmarks = controller.landmarks.landmarks.value;
  const placed = neededNames.every((name) => pointOf(landmarks, name) !== null);
  const draft = store.draft.value;
  return (
    <>
      <p class="soft">{placed ? caseText.planHint : caseText.planNeeds}</p>
      <TargetFields targets={targets} reamers={store.reamers.value} />
      <div class="buttons">
        <Button
          look="main"
          testId="propose"
          disabled={!placed || store.busy.value}
          onClick={() => void controller.proposePlan(targets.request())}
        >
          {draft === null ? caseText.propose : caseText.proposeAgain}
        </Button>
      </div>
      {store.planBeforeLandmarks.value && draft?.kept === true && (
        <Message kind="warn">{caseText.planOutdated}</Message>
      )}
      {draft !== null && <PlanDraftPanel controller={controller} draft={draft} />}
    </>
  );
}

function TargetFields({ targets, reamers }: { targets: PlanTargetsStore; reamers: readonly Reamer[] }) {
  return (
    <>
      <AngleFields targets={targets} />
      <NumberField
        {...{ label: caseText.depth, unit: caseText.mm, value: targets.depthMm.value, low: 0, high: 15, step: 0.5 }}
        testId="wanted-depth"
        onChange={(value) => (targets.depthMm.value = value)}
      />
      <GivenNumber
        label={caseText.implantRadius}
        value={targets.implantRadiusMm.value}
        {...{ low: 20, high: 60, usual: 32, testId: 'implant-radius' }}
        onChange={(value) => (targets.implantRadiusMm.value = value)}
      />
      <SelectField<ImplantName | ''>
        label={caseText.implant}
        value={targets.implant.value ?? ''}
        options={[['', caseText.implantUsual], ...implantNames.map((name) => [name, name] as const)]}
        testId="implant"
        onChange={(name) => (targets.implant.value = name === '' ? null : name)}
      />
      <ReamerFields targets={targets} reamers={reamers} />
      <PilotFields targets={targets} />
    </>
  );
}

function AngleFields({ targets }: { targets: PlanTargetsStore }) {
  return (
    <>
      <SignedAngle
        label={caseText.wantedVersion}
        value={targets.versionDeg.value}
        positive={caseText.anteversionWord}
        negative={caseText.retroversionWord}
        testId="wanted-version"
        onChange={(degrees) => (targets.versionDeg.value = degrees)}
      />
      <SignedAngle
        label={caseText.wantedInclination}
        value={targets.inclinationDeg.value}
        positive={caseText.superiorWord}
        negative={caseText.inferiorWord}
        unset={caseText.inclinationKept}
        testId="wanted-inclination"
        onChange={(degrees) => (targets.inclinationDeg.value = degrees)}
      />
    </>
  );
}

/** The reamer and what leads it. */
function ReamerFields({ targets, reamers }: { targets: PlanTargetsStore; reamers: readonly Reamer[] }) {
  return (
    <>
      <SelectField
        label={caseText.reamer}
        value={targets.reamer.value ?? ''}
        options={[['', caseText.reamerDefault], ...reamers.map((one) => [one.name, reamerText(one)] as const)]}
        testId="reamer"
        onChange={(name) => (targets.reamer.value = name === '' ? null : name)}
      />
      <SelectField<Guide | ''>
        label={caseText.guide}
        value={targets.guide.value ?? ''}
        options={[
          ['', caseText.byReamer],
          ...(['none', 'nipple', 'pin'] as const).map((guide) => [guide, caseText.guides[guide]] as const),
        ]}
        testId="guide"
        onChange={(guide) => (targets.guide.value = guide === '' ? null : guide)}
      />
    </>
  );
}

function PilotFields({ targets }: { targets: PlanTargetsStore }) {
  const mm = caseText.mm;
  const pilot = targets.pilot.value;
  return (
    <>
      <SelectField<'' | 'given'>
        label={caseText.pilotHole}
        value={pilot === null ? '' : 'given'}
        options={[
          ['', caseText.byReamer],
          ['given', caseText.pilotGiven],
        ]}
        testId="pilot"
        onChange={(given) => (targets.pilot.value = given === '' ? null : { diameterMm: 6.2, depthMm: 12 })}
      />
      {pilot !== null && (
        <>
          <NumberField
            {...{ label: caseText.pilotDiameter, unit: mm, value: pilot.diameterMm, low: 1, high: 12, step: 0.1 }}
            testId="pilot-diameter"
            onChange={(diameterMm) => (targets.pilot.value = { ...pilot, diameterMm })}
          />
          <NumberField
            {...{ label: caseText.pilotDepth, unit: mm, value: pilot.depthMm, low: 1, high: 40, step: 0.5 }}
            testId="pilot-depth"
            onChange={(depthMm) => (targets.pilot.value = { ...pilot, depthMm })}
          />
        </>
      )}
    </>
  );
}

interface GivenParts {
  label: string;
  value: number | null;
  low: number;
  high: number;
  /** With which it begins once it is given. */
  usual: number;
  testId: string;
  onChange: (value: number | null) => void;
}

/** A length that may be left open. */
function GivenNumber({ label, value, low, high, usual, testId, onChange }: GivenParts) {
  const isGiven = value !== null;
  return (
    <div class="field field-row">
      <CheckField
        label={label}
        checked={isGiven}
        testId={`${testId}-given`}
        onChange={(given) => onChange(given ? usual : null)}
      />
      {isGiven ? (
        <NumberBox {...{ label, unit: caseText.mm, value, low, high, step: 0.5, testId }} onChange={onChange} />
      ) : (
        <span class="soft">{caseText.byReamer}</span>
      )}
    </div>
  );
}

interface AngleParts {
  label: string;
  /** Degrees; null: not given. */
  value: number | null;
  positive: string;
  negative: string;
  /** Words for not giving it; absent: it must be given. */
  unset?: string;
  testId: string;
  onChange: (degrees: number | null) => void;
}

/** An angle by its size and the word for its direction, so that no sign has to be known. */
function SignedAngle({ label, value, positive, negative, unset, testId, onChange }: AngleParts) {
  // Of an angle of zero the direction is what was chosen last.
  const [negativeAtZero, setNegativeAtZero] = useState(true);
  const towardsNegative = value !== null && (value < 0 || (value === 0 && negativeAtZero));
  const size = Math.abs(value ?? 0);
  const way = value === null ? '' : towardsNegative ? negative : positive;
  return (
    <div class="field field-row">
      <span class="field-name">{label}</span>
      <span class="number-box">
        {value !== null && (
          <>
            <input
              type="number"
              aria-label={label}
              data-testid={testId}
              {...{ min: 0, max: 40, step: 0.5, value: String(size) }}
              onChange={(event) => {
                const typed = Math.min(Math.abs(event.currentTarget.valueAsNumber), 40);
                if (Number.isFinite(typed)) onChange(towardsNegative ? -typed : typed);
              }}
            />
            <span class="unit">°</span>
          </>
        )}
        <select
          aria-label={label}
          data-testid={`${testId}-direction`}
          value={way}
          onChange={({ currentTarget: { value: chosen } }) => {
            setNegativeAtZero(chosen === negative);
            onChange(chosen === '' ? null : chosen === negative ? -size : size);
          }}
        >
          {unset !== undefined && <option value="">{unset}</option>}
          <option value={negative}>{negative}</option>
          <option value={positive}>{positive}</option>
        </select>
      </span>
    </div>
  );
}
