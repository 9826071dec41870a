import { type Hand, levelLeastN, levelMostN } from '../../practice/hand';
import { levels } from '../../practice/level';
import { leanMaxDeg } from '../../practice/plan_frame';
import type { PracticeStore } from '../../state/practice_store';
import { appText } from '../../text/app_text';
import { fixed } from '../../text/format';
import { HoldButton } from '../common/hold_button';

/** What the hand does, and buttons for all of it: for a person without keys, and to see what the keys did. */
export function PracticeBar({ practice, toPicture }: { practice: PracticeStore; toPicture: () => void }) {
  const { hand } = practice;
  return (
    <section class="practice" aria-label={appText.practice} data-testid="practice-bar">
      <div class="practice-buttons">
        <DriveButtons hand={hand} onDone={(event) => afterClick(event, toPicture)} />
        <HoldButton
          class="hand-button"
          id="push"
          onPointerDone={toPicture}
          onHold={(held) => {
            if (held) hand.takeHold();
            hand.push('button', held ? 1 : 0);
          }}
        >
          {appText.pushButton}
        </HoldButton>
        <WithdrawButton hand={hand} onDone={toPicture} />
        <PauseButton hand={hand} onDone={(event) => afterClick(event, toPicture)} />
        <p class="soft off-plan" data-testid="off-plan">
          {appText.offPlan(fixed(practice.offPlanMm.value, 1))}
        </p>
        <HandState practice={practice} />
      </div>
      <PushMeter practice={practice} />
      <Lean practice={practice} />
    </section>
  );
}

interface HandButtonParts {
  hand: Hand;
  /** After a click. */
  onDone: (event: MouseEvent) => void;
}

interface SwitchParts {
  id: string;
  on: boolean;
  label: string;
  /** The label says what a press does, and changes with it: then nothing else says whether it is on. */
  command?: boolean;
  onPress: (event: MouseEvent) => void;
}

/** A switch of the hand's: lit while it is on. */
function HandButton({ id, on, label, command, onPress }: SwitchParts) {
  const pressed = command === true ? undefined : on;
  return (
    <button type="button" class="hand-button" data-testid={id} data-on={on} aria-pressed={pressed} onClick={onPress}>
      {label}
    </button>
  );
}

/** Spindle and irrigation; whoever presses one takes hold of the reamer. */
export function DriveButtons({ hand, onDone }: HandButtonParts) {
  const press = (action: () => void) => (event: MouseEvent) => {
    hand.takeHold();
    action();
    onDone(event);
  };
  const spindleOn = hand.spindleOn.value;
  return (
    <>
      <HandButton
        id="spindle"
        on={spindleOn}
        label={appText.spindleButton(spindleOn)}
        command
        onPress={press(() => hand.toggleSpindle())}
      />
      <HandButton
        id="irrigation"
        on={hand.irrigating.value}
        label={appText.irrigationButton}
        onPress={press(() => hand.toggleIrrigation())}
      />
    </>
  );
}

/** For a touch screen: no finger on the picture withdraws. */
export function WithdrawButton({ hand, onDone }: { hand: Hand; onDone: () => void }) {
  return (
    <HoldButton
      class="hand-button"
      id="withdraw"
      onPointerDone={onDone}
      onHold={(held) => {
        if (held) hand.takeHold();
        hand.withdraw('button', held ? 1 : 0);
      }}
    >
      {appText.withdrawButton}
    </HoldButton>
  );
}

export function PauseButton({ hand, onDone }: HandButtonParts) {
  const paused = hand.paused.value;
  const press = (event: MouseEvent) => {
    hand.togglePause();
    onDone(event);
  };
  return <HandButton id="pause" on={paused} label={appText.pauseButton(paused)} command onPress={press} />;
}

/** After a click with the mouse the keys go to the picture again, where space pushes; after one with a key they stay. */
function afterClick(event: MouseEvent, toPicture: () => void): void {
  if (event.detail > 0) toPicture();
}

/** The push as it is set and the thrust that comes of it (a mark), and below how hard a full push is; one scale. */
function PushMeter({ practice }: { practice: PracticeStore }) {
  const { hand } = practice;
  const { ownPressure } = levels[practice.level.value];
  const pushN = hand.pushN.value;
  const thrustN = practice.feedback.value?.thrustN ?? 0;
  const share = (newtons: number) => `${((Math.max(newtons, 0) / levelMostN) * 100).toFixed(1)}%`;
  return (
    <div class="push">
      <span aria-hidden="true">{appText.push}</span>
      <div
        class="push-meter"
        role="meter"
        aria-label={appText.push}
        aria-valuemin={0}
        aria-valuemax={levelMostN}
        aria-valuenow={Math.max(pushN, 0)}
        aria-valuetext={appText.pushMeter(fixed(pushN, 0), fixed(ownPressure ? levelMostN : hand.levelN.value, 0))}
      >
        <div class="push-now" style={{ width: share(pushN) }} />
        <div class="push-thrust" style={{ left: share(thrustN) }} />
      </div>
      <span class="push-figure">
        <strong data-testid="push-now">{fixed(pushN, 0)}</strong> N
      </span>
      {!ownPressure && <PushLevel hand={hand} />}
    </div>
  );
}

function PushLevel({ hand }: { hand: Hand }) {
  return (
    <>
      <label for="push-level">{appText.pushLevel}</label>
      <input
        id="push-level"
        type="range"
        data-testid="push-level"
        aria-valuetext={`${fixed(hand.levelN.value, 0)} N`}
        min={0}
        max={levelMostN}
        step={1}
        value={hand.levelN.value}
        onInput={(event) => hand.setLevel(Math.max(event.currentTarget.valueAsNumber, levelLeastN))}
      />
      <span class="push-figure">
        <strong>{fixed(hand.levelN.value, 0)}</strong> N
      </span>
    </>
  );
}

function Lean({ practice }: { practice: PracticeStore }) {
  const { hand } = practice;
  const lean = hand.lean.value;
  const slider = (direction: 'superior' | 'anterior', label: string) => (
    <label>
      {label} <span class="lean-value">{appText.degrees(fixed(lean[direction], 0))}</span>
      <input
        type="range"
        data-testid={`lean-${direction}`}
        min={-leanMaxDeg}
        max={leanMaxDeg}
        step={0.5}
        value={lean[direction]}
        onInput={(event) => hand.leanTo({ ...hand.lean.value, [direction]: event.currentTarget.valueAsNumber })}
        onDblClick={() => hand.leanTo({ ...hand.lean.value, [direction]: 0 })}
      />
    </label>
  );
  return (
    <div class="lean" role="group">
      {slider('superior', appText.leanUp)}
      {slider('anterior', appText.leanFront)}
    </div>
  );
}

/** Whether the reamer is in this page's hand, and how long the way there and back takes. */
function HandState({ practice }: { practice: PracticeStore }) {
  const link = practice.link.value.kind;
  const feedback = practice.feedback.value;
  const slow = feedback !== null && feedback.link !== 'fresh';
  const look = link === 'holding' ? (slow ? 'silent' : 'live') : link === 'lost' ? 'lost' : 'silent';
  return (
    <p class={`hand-link link-${look}`} data-testid="hand-link" data-link={link} title={appText.handLink}>
      <span class="link-dot" aria-hidden="true" />
      <span role="status">
        {deviceStateText(practice)}
        {practice.gamepad.value && ` · ${appText.gamepadFound}`}
      </span>
      {feedback !== null && feedback.rttMs !== null && (
        <span class="soft rtt">{appText.roundTrip(fixed(feedback.rttMs, 0))}</span>
      )}
    </p>
  );
}

function deviceStateText(practice: PracticeStore): string {
  switch (practice.link.value.kind) {
    case 'connecting':
      return appText.handConnecting;
    case 'silent':
      return appText.handSilent;
    case 'lost':
    case 'ended':
      return appText.handLost;
    case 'holding':
      switch (practice.feedback.value?.link) {
        case 'held':
          return appText.handHeld;
        case 'fading':
          return appText.handFading;
        case 'lost':
          return appText.handLost;
        case 'fresh':
        case undefined:
          return appText.handHolding;
      }
  }
}
