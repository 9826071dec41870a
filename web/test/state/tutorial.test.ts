import { describe, expect, it } from 'vitest';

import {
  advanced,
  type Astray,
  type StepName,
  stepNames,
  strayed,
  type TutorialSnapshot,
} from '../../src/state/tutorial';
import { tutorialText } from '../../src/text/tutorial_text';

const atFirst: TutorialSnapshot = {
  steering: true,
  ended: false,
  failed: false,
  canZoom: true,
  turnedDeg: 0,
  mostTurnedDeg: 0,
  zoomed: 1,
  besideMm: 7,
  leanDeg: 0,
  spindleOn: false,
  spindleTurns: false,
  stalled: false,
  irrigating: false,
  touching: false,
  pushN: 0,
  thrustN: 0,
  depthMm: 0,
  plannedMm: 2,
  drawnBackMm: 0,
};

const turning = { besideMm: 0.3, spindleOn: true, spindleTurns: true, irrigating: true };
const pressing = { ...turning, touching: true, pushN: 52, thrustN: 50 };
/** What each step asks for. */
const asked: Readonly<Record<StepName, Partial<TutorialSnapshot>>> = {
  look: { mostTurnedDeg: 20, zoomed: 1.1 },
  aim: { besideMm: 1.4 },
  spindle: turning,
  touch: { ...pressing, pushN: 12, thrustN: 11 },
  press: { ...pressing, depthMm: 0.6 },
  stop: { ...turning, touching: true, depthMm: 1.9, thrustN: 1 },
  withdraw: { ...turning, pushN: -20, depthMm: 1.9, drawnBackMm: 4.1 },
  result: { besideMm: 0.3, steering: false, ended: true, depthMm: 1.9, drawnBackMm: 4.1 },
};
const at = (name: StepName) => stepNames.indexOf(name);
const now = (changes: Partial<TutorialSnapshot>): TutorialSnapshot => ({ ...atFirst, ...changes });
const stays = (name: StepName, changes: Partial<TutorialSnapshot>) =>
  expect(advanced(at(name), now({ ...asked[name], ...changes })), `${name} ${JSON.stringify(changes)}`).toBe(at(name));
const says = (name: StepName, changes: Partial<TutorialSnapshot>) => strayed(at(name), now(changes));

describe('the tutorial', () => {
  it('goes from step to step by what each asks for, and ends', () => {
    let step = 0;
    for (const name of stepNames) {
      expect(stepNames[step]).toBe(name);
      step = advanced(step, now(asked[name]));
    }
    expect(step).toBe(stepNames.length);
    expect(advanced(step, now(asked.result))).toBe(step);
    expect(strayed(step, now(asked.result))).toBeNull();
  });

  it('goes on for nothing less than what is asked', () => {
    stays('look', { mostTurnedDeg: 10 });
    stays('look', { zoomed: 1 });
    stays('aim', { besideMm: 1.6 });
    stays('aim', { leanDeg: 6 });
    stays('aim', { touching: true });
    stays('spindle', { spindleTurns: false });
    stays('spindle', { irrigating: false });
    stays('touch', { touching: false });
    stays('touch', { thrustN: 26 });
    stays('touch', { besideMm: 3 });
    stays('touch', { spindleTurns: false });
    stays('press', { thrustN: 34 });
    stays('press', { thrustN: 71 });
    stays('press', { depthMm: 0.4 });
    stays('press', { besideMm: 3 });
    stays('stop', { depthMm: 1.69 });
    stays('stop', { pushN: 12 });
    stays('stop', { thrustN: 30 });
    stays('withdraw', { drawnBackMm: 3 });
    stays('withdraw', { touching: true });
    stays('withdraw', { spindleTurns: false });
    stays('result', { ended: false });
    stays('result', { failed: true });
  });

  it('lets who cannot zoom look from the side and come back', () => {
    const seen = { canZoom: false, mostTurnedDeg: 60 };
    expect(advanced(0, now({ ...seen, turnedDeg: 60 }))).toBe(0);
    expect(advanced(0, now({ ...seen, turnedDeg: 1 }))).toBe(1);
  });

  it('does not make anybody press who has come to the plan gently', () => {
    expect(advanced(at('press'), now({ ...asked.touch, depthMm: 1.8 }))).toBe(at('stop'));
  });

  it('takes 0.3 mm to either side of the plan for the plan', () => {
    for (const depthMm of [1.71, 2, 2.29])
      expect(advanced(at('stop'), now({ ...asked.stop, depthMm })), `${depthMm}`).toBe(at('withdraw'));
  });

  it('says at every step that it was too deep, and goes no further', () => {
    for (const name of stepNames) {
      expect(says(name, { ...asked[name], depthMm: 2.31 }), name).toBe('tooDeep');
      stays(name, { depthMm: 2.31 });
    }
  });

  it('says when the session has ended too early, or the reamer is not in the hand', () => {
    for (const name of stepNames) {
      const ended = { ...asked[name], steering: false, ended: true };
      expect(says(name, ended), name).toBe(name === 'result' ? null : 'endedEarly');
      expect(says(name, { ...asked[name], steering: false, ended: false }), name).toBe('notInHand');
    }
    stays('withdraw', { ended: true });
    expect(says('result', { ...asked.result, failed: true })).toBe('endedEarly');
  });

  it('goes on saying a thing until it is clearly over', () => {
    const goesOn = (name: StepName, said: Astray, changes: Partial<TutorialSnapshot>) =>
      strayed(at(name), now(changes), said) === said;
    expect(goesOn('look', 'tooEarly', { pushN: 10 })).toBe(true);
    expect(goesOn('look', 'tooEarly', { touching: true })).toBe(false);
    expect(goesOn('touch', 'tooHard', { ...pressing, thrustN: 22 })).toBe(true);
    expect(goesOn('touch', 'tooHard', { ...pressing, thrustN: 19 })).toBe(false);
    expect(goesOn('press', 'tooHard', { ...pressing, thrustN: 75 })).toBe(true);
    expect(goesOn('press', 'tooHard', { ...pressing, thrustN: 70 })).toBe(false);
    expect(goesOn('press', 'offAxis', { ...pressing, besideMm: 1.8 })).toBe(true);
    expect(goesOn('press', 'offAxis', { ...pressing, besideMm: 1.4 })).toBe(false);
    expect(goesOn('stop', 'tooShallow', { ...turning, touching: true, depthMm: 1.2, pushN: 5 })).toBe(true);
    expect(goesOn('stop', 'tooShallow', { ...turning, touching: true, depthMm: 1.2, pushN: 12 })).toBe(false);
    expect(goesOn('result', 'pressesOn', { ...turning, depthMm: 2, pushN: 10 })).toBe(true);
  });

  it('says what was done too early, too hard, beside, or too little', () => {
    expect(says('look', { touching: true, pushN: 10 })).toBe('tooEarly');
    expect(says('aim', { touching: true, pushN: 10 })).toBe('tooEarly');
    expect(says('touch', { besideMm: 0, touching: true, pushN: 10 })).toBe('spindleOff');
    expect(says('touch', { ...pressing, thrustN: 30 })).toBe('tooHard');
    expect(says('press', { ...pressing, thrustN: 70 })).toBeNull();
    expect(says('press', { ...pressing, thrustN: 79 })).toBe('tooHard');
    expect(says('press', { ...pressing, besideMm: 2.1 })).toBe('offAxis');
    expect(says('press', { ...pressing, leanDeg: 8 })).toBe('offAxis');
    expect(says('press', { ...pressing, spindleTurns: false, stalled: true })).toBe('stalled');
    expect(says('stop', { ...turning, touching: true, depthMm: 1.2 })).toBe('tooShallow');
    expect(says('withdraw', { ...asked.withdraw, spindleOn: false, spindleTurns: false })).toBe('spindleOff');
    expect(says('withdraw', { ...pressing, depthMm: 2 })).toBe('pressesOn');
    for (const name of stepNames) expect(says(name, asked[name]), name).toBeNull();
  });
});

describe('the words of the tutorial', () => {
  const inputs = ['mouse', 'touch', 'keys', 'gamepad'] as const;

  it('are one or two sentences for each step and input, which name a key, a button or a gesture', () => {
    for (const name of stepNames)
      for (const input of inputs) {
        const text = tutorialText.todo[name]('2')[input];
        expect(text, `${name} ${input}`).toMatch(/^[A-Z][^.!?]*\.( [A-Z][^.!?]*\.)?$/);
        expect(text, `${name} ${input}`).toMatch(/\[[^\]]+\]|move the pointer/i);
      }
  });

  it('name no mouse to who has none', () => {
    for (const name of stepNames)
      for (const input of ['touch', 'keys'] as const)
        expect(tutorialText.todo[name]('2.00')[input]).not.toMatch(/button\]|wheel|pointer/);
    for (const strayedText of Object.values(tutorialText.strayed))
      expect(strayedText('keys')).not.toMatch(/button\]|wheel|pointer|finger|trigger/);
  });
});
