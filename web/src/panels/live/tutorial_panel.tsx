import '../../styles/tutorial.css';

import { useEffect, useState } from 'preact/hooks';

import type { PracticeStore } from '../../state/practice_store';
import { addressOfRoute } from '../../state/route';
import type { Store } from '../../state/store';
import { type Astray, stepNames } from '../../state/tutorial';
import type { Tutorial } from '../../state/tutorial_guide';
import { appText } from '../../text/app_text';
import { fixed } from '../../text/format';
import { tutorialText } from '../../text/tutorial_text';
import { Button } from '../common/button';
import { useFocusAfter } from '../common/focus_after';
import { TutorialGauge } from './tutorial_gauge';

interface Parts {
  store: Store;
  tutorial: Tutorial;
  practice: PracticeStore;
  toPicture: () => void;
}

/** One step of the tutorial: what to do, why, and how one has left the path. */
export function TutorialPanel({ store, tutorial, practice, toPicture }: Parts) {
  const name = tutorial.stepName.value;
  const shown = tutorial.begun.value ? (name ?? 'finished') : 'loading';
  useEscape(() => {
    leave(tutorial);
    toPicture();
  });
  return (
    <section class="tutorial" aria-labelledby="tutorial-title" data-testid="tutorial" data-step={shown}>
      <Progress step={tutorial.step.value} />
      <Words store={store} tutorial={tutorial} />
      {name !== null && <TutorialGauge step={name} store={store} practice={practice} />}
      <Buttons {...{ store, tutorial, toPicture }} />
    </section>
  );
}

/** Skipped while there is something left to do, else only closed. */
function leave(tutorial: Tutorial): void {
  if (tutorial.stepName.value === null) tutorial.close();
  else tutorial.skip();
}

function useEscape(action: () => void): void {
  useEffect(() => {
    const onKey = (event: KeyboardEvent) => {
      if (event.key !== 'Escape' || event.defaultPrevented) return;
      event.preventDefault();
      action();
    };
    document.addEventListener('keydown', onKey);
    return () => document.removeEventListener('keydown', onKey);
  });
}

function Progress({ step }: { step: number }) {
  const all = stepNames.length;
  return (
    <div class="tutorial-head">
      <h2 id="tutorial-title">{tutorialText.tutorial}</h2>
      <p data-testid="tutorial-progress">
        {step < all ? tutorialText.progress(step + 1, all) : tutorialText.progressDone}
      </p>
      <ol class="tutorial-marks" aria-hidden="true">
        {stepNames.map((name, i) => (
          <li key={name} class={i < step ? 'done' : i === step ? 'next' : ''}>
            {i < step ? '✓' : ''}
          </li>
        ))}
      </ol>
    </div>
  );
}

/** Said aloud when it changes. What is said first comes a moment after its place, or it would not be heard. */
function Words({ store, tutorial }: Pick<Parts, 'store' | 'tutorial'>) {
  const [placed, setPlaced] = useState(false);
  useEffect(() => setPlaced(true), []);
  const step = tutorial.step.value;
  const astray = tutorial.astray.value;
  const before = stepNames[step - 1];
  return (
    <div class="tutorial-words" aria-live="polite">
      {placed && before !== undefined && (
        <p class="tutorial-done" data-testid="tutorial-done">
          <span aria-hidden="true">✓</span> {tutorialText.done[before]}
        </p>
      )}
      {placed && astray !== null && (
        <p class="tutorial-astray" data-testid="tutorial-astray" data-astray={astray}>
          <span aria-hidden="true">{isLost(astray) ? '⬣' : '▲'}</span>{' '}
          <Named text={tutorialText.strayed[astray](tutorial.input.value)} />
        </p>
      )}
      {placed && !isLost(astray) && <NextThing store={store} tutorial={tutorial} />}
    </div>
  );
}

function NextThing({ store, tutorial }: Pick<Parts, 'store' | 'tutorial'>) {
  const name = tutorial.stepName.value;
  const planned = fixed(store.hello.value?.plannedDepthMm, 2);
  const depth = fixed(store.reading.value.telemetry?.depthMm, 2);
  // What is done before the picture is there would have to be done again.
  if (!tutorial.begun.value) return tutorial.astray.value === null && <p class="tutorial-why">{appText.loading}</p>;
  const todo =
    name === null ? tutorialText.closing(depth, planned) : tutorialText.todo[name](planned)[tutorial.input.value];
  return (
    <>
      <p class="tutorial-do" data-testid="tutorial-do">
        <Named text={todo} />
      </p>
      {tutorial.astray.value === null && (
        <p class="tutorial-why">{name === null ? tutorialText.closingWhy : tutorialText.why[name]}</p>
      )}
    </>
  );
}

/** Keys, buttons and parts of the mouse stand in square brackets and are drawn as such. */
function Named({ text }: { text: string }) {
  return <>{text.split(/\[([^\]]+)\]/).map((part, i) => (i % 2 === 1 ? <kbd key={i}>{part}</kbd> : part))}</>;
}

function Buttons({ store, tutorial, toPicture }: Omit<Parts, 'practice'>) {
  const name = tutorial.stepName.value;
  const astray = tutorial.astray.value;
  const lost = isLost(astray);
  const busy = store.busy.value;
  const session = tutorial.session.value;
  // The button that ended the session is gone.
  const review = useFocusAfter<HTMLAnchorElement>(name === null);
  return (
    <div class="tutorial-buttons">
      <Button
        testId="tutorial-skip"
        title={name === null ? undefined : tutorialText.skipHint}
        onClick={() => {
          leave(tutorial);
          toPicture();
        }}
      >
        {name === null ? tutorialText.close : tutorialText.skip}
      </Button>
      <Button
        look={lost ? 'main' : 'plain'}
        testId="tutorial-again"
        title={astray === 'notInHand' ? tutorialText.againOwnHint : tutorialText.againHint}
        disabled={busy}
        onClick={() => void tutorial.again()}
      >
        {busy ? appText.starting : tutorialText.again}
      </Button>
      {name === null && session !== null && (
        <a class="plain-button" ref={review} href={addressOfRoute({ kind: 'review', id: session, beside: null })}>
          {tutorialText.review}
        </a>
      )}
      {name === 'result' && !lost && astray !== 'notInHand' && (
        <Button look="main" testId="tutorial-stop" disabled={busy} onClick={() => void tutorial.stop()}>
          {appText.stop}
        </Button>
      )}
    </div>
  );
}

/** Nothing is left but to start again. */
const isLost = (astray: Astray | null) => astray === 'tooDeep' || astray === 'endedEarly';
