import { useSignal } from '@preact/signals';

import { caseText } from '../../text/case_text';
import type { CaseController } from '../../state/case/case_controller';
import { isUnderWay } from '../../state/case/job_watch';
import type { CaseBuilt } from '../../wire/rest_types';
import { fixed } from '../../text/format';
import { Message, SelectField, SliderField } from '../common/fields';
import { Button } from '../common/button';

const finest = 8;

/** How fine and how much, cartilage, and building the bone that is reamed. */
export function BuildStep({ controller }: { controller: CaseController }) {
  const { store } = controller;
  const details = store.details.value;
  const built = details?.built ?? null;
  const upsample = useSignal(built?.upsample ?? 4);
  const roi = useSignal<'glenoid' | 'whole'>('glenoid');
  const cartilageMm = useSignal(built?.cartilage_mm ?? 0);
  const found = details?.segmentation ?? null;
  const hasCentre = controller.landmarks.landmarks.value.glenoid_centre_mm !== undefined;
  const lacksCentre = !hasCentre && (roi.value === 'glenoid' || cartilageMm.value > 0);
  const blocked = found === null || lacksCentre || store.busy.value || isUnderWay(store.job.value);
  return (
    <>
      <p class="soft">{found === null ? caseText.buildNeeds : caseText.buildHint}</p>
      <SelectField
        label={caseText.upsample}
        value={String(upsample.value)}
        options={Array.from({ length: finest }, (_, i) => [String(i + 1), caseText.upsampleTimes(i + 1)] as const)}
        testId="upsample"
        onChange={(times) => (upsample.value = Number(times))}
      />
      <SelectField<'glenoid' | 'whole'>
        label={caseText.roi}
        value={roi.value}
        options={[
          ['glenoid', caseText.roiGlenoid],
          ['whole', caseText.roiWhole],
        ]}
        testId="roi"
        onChange={(chosen) => (roi.value = chosen)}
      />
      <SliderField
        {...{ label: caseText.cartilage, unit: caseText.mm, value: cartilageMm.value, low: 0, high: 5, step: 0.5 }}
        testId="cartilage"
        onChange={(thickness) => (cartilageMm.value = thickness)}
      />
      {lacksCentre && found !== null && <Message kind="warn">{caseText.buildNeedsCentre}</Message>}
      <div class="buttons">
        <Button
          look="main"
          testId="run-build"
          disabled={blocked}
          onClick={() =>
            void controller.landmarks
              .saveNow()
              .then(() =>
                controller.build({ upsample: upsample.value, roi: roi.value, cartilage_mm: cartilageMm.value }),
              )
          }
        >
          {built === null ? caseText.runBuild : caseText.runBuildAgain}
        </Button>
      </div>
      {built !== null && <Built built={built} outdated={built.segmentation_revision !== found?.revision} />}
    </>
  );
}

function Built({ built, outdated }: { built: CaseBuilt; outdated: boolean }) {
  const [low, high] = built.density_range_g_cc;
  return (
    <section data-testid="built">
      {outdated && <Message kind="warn">{caseText.builtOutdated}</Message>}
      <h3>{caseText.built}</h3>
      <ul class="facts">
        <li>{caseText.builtVoxels(fixed(built.bone_voxels / 1e6, 2))}</li>
        <li>{caseText.builtUpsample(built.upsample)}</li>
        <li>{caseText.builtDensity(fixed(low, 2), fixed(high, 2))}</li>
      </ul>
    </section>
  );
}
