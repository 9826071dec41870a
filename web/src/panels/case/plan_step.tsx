import { signal } from '@preact/signals';
import { useMemo } from 'preact/hooks';

import { caseWords } from '../../case_words';
import type { CaseKeeper } from '../../state/case/case_keeper';
import { neededNames, pointOf } from '../../state/case/landmark_names';
import type { Guide, PlanWishes, Reamer } from '../../wire/case_types';
import { fixed } from '../format';
import { NumberField, Remark, SelectField, CheckField } from './fields';
import { PlanDraftPanel } from './plan_draft_panel';

/** What is wished of the plan; the wishes last as long as the page is open. */
export class PlanWishesStore {
  readonly versionDeg = signal(0);
  readonly inclinationDeg = signal(0);
  readonly depthMm = signal(2);
  /** Null: as the server suggests. */
  readonly implantRadiusMm = signal<number | null>(null);
  /** As a plan names it; null: as the server suggests. */
  readonly reamer = signal<string | null>(null);
  readonly pilot = signal(true);
  readonly pilotDiameterMm = signal(6.2);
  readonly pilotDepthMm = signal(12);
  readonly guide = signal<Guide>('none');

  wishes(): PlanWishes {
    const pilot = this.pilot.value
      ? { pilot_diameter_mm: this.pilotDiameterMm.value, pilot_depth_mm: this.pilotDepthMm.value }
      : {};
    return {
      version_deg: this.versionDeg.value,
      inclination_deg: this.inclinationDeg.value,
      depth_mm: this.depthMm.value,
      guide: this.guide.value,
      ...(this.implantRadiusMm.value === null ? {} : { implant_radius_mm: this.implantRadiusMm.value }),
      ...(this.reamer.value === null ? {} : { reamer: this.reamer.value }),
      ...pilot,
    };
  }
}

/** A proposal from what is wished, the plan by numbers, and keeping it. */
export function PlanStep({ keeper, wishes }: { keeper: CaseKeeper; wishes: PlanWishesStore }) {
  const { store } = keeper;
  const landmarks = keeper.landmarks.landmarks.value;
  const placed = neededNames.every((name) => pointOf(landmarks, name) !== null);
  const draft = store.draft.value;
  return (
    <>
      <p class="soft">{placed ? caseWords.planHint : caseWords.planNeeds}</p>
      <WishFields wishes={wishes} reamers={store.reamers.value} />
      <div class="buttons">
        <button
          type="button"
          class="main-button"
          data-testid="propose"
          disabled={!placed || store.busy.value}
          onClick={() => void keeper.proposePlan(wishes.wishes())}
        >
          {draft === null ? caseWords.propose : caseWords.proposeAgain}
        </button>
      </div>
      {store.planBeforeLandmarks.value && draft?.kept === true && (
        <Remark kind="warn">{caseWords.planOutdated}</Remark>
      )}
      {draft !== null && <PlanDraftPanel keeper={keeper} draft={draft} />}
    </>
  );
}

function WishFields({ wishes, reamers }: { wishes: PlanWishesStore; reamers: readonly Reamer[] }) {
  const mm = caseWords.mm;
  return (
    <>
      <SignedAngle
        label={caseWords.wantedVersion}
        value={wishes.versionDeg.value}
        positive={caseWords.anteversionWord}
        negative={caseWords.retroversionWord}
        testId="wanted-version"
        onChange={(degrees) => (wishes.versionDeg.value = degrees)}
      />
      <SignedAngle
        label={caseWords.wantedInclination}
        value={wishes.inclinationDeg.value}
        positive={caseWords.superiorWord}
        negative={caseWords.inferiorWord}
        testId="wanted-inclination"
        onChange={(degrees) => (wishes.inclinationDeg.value = degrees)}
      />
      <NumberField
        {...{ label: caseWords.depth, unit: mm, value: wishes.depthMm.value, low: 0, high: 15, step: 0.5 }}
        testId="wanted-depth"
        onChange={(value) => (wishes.depthMm.value = value)}
      />
      <ReamerField wishes={wishes} reamers={reamers} />
      <SelectField<Guide>
        label={caseWords.guide}
        value={wishes.guide.value}
        options={(['none', 'nipple', 'pin'] as const).map((guide) => [guide, caseWords.guides[guide]] as const)}
        testId="guide"
        onChange={(guide) => {
          wishes.guide.value = guide;
          if (guide === 'nipple') wishes.pilot.value = true;
        }}
      />
      <CheckField
        label={caseWords.pilotHole}
        checked={wishes.pilot.value}
        testId="pilot"
        onChange={(pilot) => {
          wishes.pilot.value = pilot;
          if (!pilot && wishes.guide.value === 'nipple') wishes.guide.value = 'none';
        }}
      />
      {wishes.pilot.value && (
        <>
          <NumberField
            {...{ label: caseWords.pilotDiameter, unit: mm, value: wishes.pilotDiameterMm.value, low: 1, high: 12 }}
            step={0.1}
            testId="pilot-diameter"
            onChange={(value) => (wishes.pilotDiameterMm.value = value)}
          />
          <NumberField
            {...{ label: caseWords.pilotDepth, unit: mm, value: wishes.pilotDepthMm.value, low: 1, high: 40 }}
            step={0.5}
            testId="pilot-depth"
            onChange={(value) => (wishes.pilotDepthMm.value = value)}
          />
        </>
      )}
    </>
  );
}

/** The reamer by name, or left to the server, which fits it to the implant's radius. */
function ReamerField({ wishes, reamers }: { wishes: PlanWishesStore; reamers: readonly Reamer[] }) {
  const options = useMemo(
    () => [
      ['', caseWords.reamerDefault] as const,
      ...reamers.map((reamer) => [reamer.name, reamerText(reamer)] as const),
    ],
    [reamers],
  );
  const suggestedRadiusMm = 32;
  return (
    <>
      <SelectField
        label={caseWords.reamer}
        value={wishes.reamer.value ?? ''}
        options={options}
        testId="reamer"
        onChange={(name) => (wishes.reamer.value = name === '' ? null : name)}
      />
      <CheckField
        label={caseWords.implantRadius}
        checked={wishes.implantRadiusMm.value !== null}
        testId="implant-radius-given"
        onChange={(given) => (wishes.implantRadiusMm.value = given ? suggestedRadiusMm : null)}
      />
      {wishes.implantRadiusMm.value !== null && (
        <NumberField
          {...{ label: caseWords.implantRadius, unit: caseWords.mm, value: wishes.implantRadiusMm.value }}
          {...{ low: 20, high: 60, step: 0.5, testId: 'implant-radius' }}
          onChange={(value) => (wishes.implantRadiusMm.value = value)}
        />
      )}
    </>
  );
}

function reamerText({ name, diameter_mm, radius_mm }: Reamer): string {
  const diameter = fixed(diameter_mm, 1);
  return radius_mm === null
    ? caseWords.reamerFlat(name, diameter)
    : caseWords.reamerText(name, diameter, fixed(radius_mm, 1));
}

interface AngleParts {
  label: string;
  /** Degrees. */
  value: number;
  positive: string;
  negative: string;
  testId: string;
  onChange(degrees: number): void;
}

/** An angle by its size and the word for its direction, so that no sign has to be known. */
function SignedAngle({ label, value, positive, negative, testId, onChange }: AngleParts) {
  const towardsNegative = value < 0 || Object.is(value, -0);
  return (
    <div class="field field-row">
      <span class="field-name">{label}</span>
      <span class="number-box">
        <input
          type="number"
          aria-label={label}
          data-testid={testId}
          {...{ min: 0, max: 45, step: 0.5, value: String(Math.abs(value)) }}
          onChange={(event) => {
            const size = Math.min(Math.abs(event.currentTarget.valueAsNumber), 45);
            if (Number.isFinite(size)) onChange(towardsNegative ? -size : size);
          }}
        />
        <span class="unit">°</span>
        <select
          aria-label={label}
          data-testid={`${testId}-way`}
          value={towardsNegative ? negative : positive}
          onChange={(event) => onChange(event.currentTarget.value === negative ? -Math.abs(value) : Math.abs(value))}
        >
          <option value={negative}>{negative}</option>
          <option value={positive}>{positive}</option>
        </select>
      </span>
    </div>
  );
}
