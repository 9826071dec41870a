import { levelMostN } from '../../practice/hand';
import type { PracticeStore } from '../../state/practice_store';
import type { Store } from '../../state/store';
import { aimWithin, depthWithinMm, type StepName, thrustBandN, touchMostN } from '../../state/tutorial';
import { fixed } from '../../text/format';
import { tutorialText } from '../../text/tutorial_text';

/** Beyond the plan the gauge of depth goes this much farther, mm. */
const beyondMm = 1;
/** As far as the gauge of the aim goes, mm. */
const asideMostMm = 10;

/** The number that a step is about, with the band in which it should be; others stand where they always do. */
export function TutorialGauge({ step, store, practice }: { step: StepName; store: Store; practice: PracticeStore }) {
  const telemetry = store.reading.value.telemetry;
  const plannedMm = store.hello.value?.plannedDepthMm ?? 0;
  const thrust = { name: tutorialText.thrust, now: practice.feedback.value?.thrustN ?? 0, digits: 0, most: levelMostN };
  switch (step) {
    case 'aim':
      return (
        <Gauge
          {...{ name: tutorialText.beside, now: practice.offPlanMm.value, digits: 1, most: asideMostMm, unit: 'mm' }}
          {...{ from: 0, to: aimWithin.mm }}
        />
      );
    case 'touch':
      return <Gauge {...thrust} from={0} to={touchMostN} unit="N" />;
    case 'press':
      return <Gauge {...thrust} {...thrustBandN} unit="N" />;
    case 'stop':
      return (
        <Gauge
          {...{
            name: tutorialText.depth,
            now: telemetry?.depthMm ?? 0,
            digits: 2,
            most: plannedMm + beyondMm,
            unit: 'mm',
          }}
          {...{ from: plannedMm - depthWithinMm, to: plannedMm + depthWithinMm, aim: plannedMm }}
        />
      );
    case 'look':
    case 'spindle':
    case 'withdraw':
    case 'result':
      return null;
  }
}

interface GaugeParts {
  name: string;
  now: number;
  digits: number;
  unit: string;
  most: number;
  /** The wanted band. */
  from: number;
  to: number;
  /** The middle of it, where that is what is wanted. */
  aim?: number;
}

function Gauge({ name, now, digits, unit, most, from, to, aim }: GaugeParts) {
  const share = (value: number) => Math.min(Math.max(value / most, 0), 1) * 100;
  const inside = now >= from && now <= to;
  const wanted = tutorialText.wanted(fixed(from, digits), fixed(to, digits), unit);
  return (
    <div class={inside ? 'tutorial-gauge inside' : 'tutorial-gauge'} data-testid="tutorial-gauge">
      <p>
        {name}{' '}
        <strong>
          {fixed(now, digits)} {unit}
        </strong>
        <span class="soft">{wanted}</span>
      </p>
      <div
        class="tutorial-scale"
        role="meter"
        aria-label={name}
        aria-valuemin={0}
        aria-valuemax={most}
        aria-valuenow={Math.min(Math.max(now, 0), most)}
        aria-valuetext={`${fixed(now, digits)} ${unit}, ${wanted}`}
      >
        <span class="tutorial-band" style={{ left: `${share(from)}%`, width: `${share(to) - share(from)}%` }} />
        {aim !== undefined && <span class="tutorial-aim" style={{ left: `${share(aim)}%` }} />}
        <span class="tutorial-mark" style={{ left: `${share(now)}%` }} />
      </div>
    </div>
  );
}
