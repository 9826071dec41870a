import { signal } from '@preact/signals';
import { Fragment } from 'preact';
import { useEffect, useState } from 'preact/hooks';

import type { PracticeStore } from '../../state/practice_store';
import type { Store } from '../../state/store';
import { appText } from '../../text/app_text';

const rememberedKey = 'ream.guide';
/** An aim this close to the plan is a good one, mm. */
const aimedWithinMm = 1.5;
/** A thrust that a push and no touch makes, N. */
const pressedN = 8;

/** On a phone it would cover the picture: there it comes when it is asked for. */
const hasRoom = !window.matchMedia('(max-width: 640px)').matches;
const shown = signal(hasRoom && localStorage.getItem(rememberedKey) !== 'hidden');

function show(visible: boolean): void {
  shown.value = visible;
  localStorage.setItem(rememberedKey, visible ? 'shown' : 'hidden');
}

/** The first steps in words, ticked off as they are done; once put away it stays away until asked for. */
export function Guide({ store, practice }: { store: Store; practice: PracticeStore }) {
  const steps = useSteps(store, practice);
  if (!shown.value) {
    return (
      <button type="button" class="guide-show" data-testid="guide-show" onClick={() => show(true)}>
        {appText.guideShow}
      </button>
    );
  }
  const next = steps.findIndex(([, done]) => !done);
  return (
    <section class="guide" aria-labelledby="guide-title" data-testid="guide">
      <h2 id="guide-title">{appText.guideTitle}</h2>
      <ol>
        {steps.map(([text, done], i) => (
          <li key={i} class={done ? 'done' : i === next ? 'next' : ''} data-done={done}>
            {text}
            {done && <span class="visually-hidden"> ({appText.guideDone})</span>}
          </li>
        ))}
      </ol>
      <Controls />
      <button type="button" data-testid="guide-hide" onClick={() => show(false)}>
        {appText.guideHide}
      </button>
    </section>
  );
}

/** What keys, mouse and gamepad do; at a level without hints all that is left of the guide. */
export function ControlsOnly() {
  return (
    <section class="guide" aria-label={appText.guideControls} data-testid="controls">
      <Controls />
    </section>
  );
}

function Controls() {
  return (
    <details>
      <summary>{appText.guideControls}</summary>
      <dl>
        {appText.guideControlList.map(([what, how]) => (
          <Fragment key={what}>
            <dt>{what}</dt>
            <dd>{how}</dd>
          </Fragment>
        ))}
      </dl>
    </details>
  );
}

/** Steps once done stay done for the session. */
function useSteps(store: Store, practice: PracticeStore): (readonly [text: string, done: boolean])[] {
  const plannedMm = store.hello.value?.plannedDepthMm ?? 0;
  const pressed = (practice.feedback.value?.thrustN ?? 0) > pressedN;
  const reached = [
    pressed && practice.offPlanMm.value < aimedWithinMm,
    practice.hand.spindleOn.value,
    pressed && practice.hand.spindleOn.value,
    plannedMm > 0 && (store.reading.value.telemetry?.depthMm ?? 0) >= plannedMm - 0.05,
  ];
  const [done, setDone] = useState<readonly boolean[]>([false, false, false, false]);
  const session = practice.sessionId.value;
  useEffect(() => setDone([false, false, false, false]), [session]);
  const now = done.map((was, i) => was || (reached[i] ?? false));
  useEffect(() => {
    if (now.some((is, i) => is !== done[i])) setDone(now);
  });
  const texts = [appText.guideAim, appText.guideSpindle, appText.guidePress, appText.guideDepth];
  return texts.map((text, i) => [text, now[i] ?? false] as const);
}
