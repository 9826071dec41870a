/** Texts of the tutorial. What stands in square brackets is a key, a button or a part of the mouse, named as it is. */
import type { InputKind } from '../practice/last_input';
import { appText } from './app_text';

const { irrigationButton, pushLevel, stop, takeOver, viewPlan, viewSide, withdrawButton } = appText;
const spindleOff = appText.spindleButton(false);
const again = 'Start again';

type ByInput = Readonly<Record<InputKind, string>>;

/** Ends of sentences: what is done with the input in use. */
const startSpindle: ByInput = {
  mouse: `press [${spindleOff}] below the picture`,
  touch: `tap [${spindleOff}] below the picture`,
  keys: 'press [S]',
  gamepad: 'press [A]',
};
const release: ByInput = {
  mouse: 'release the [left button]',
  touch: 'lift the [second finger]',
  keys: 'release [Space]',
  gamepad: 'release the [right trigger]',
};
const pressLess: ByInput = {
  mouse: 'turn the [wheel] down',
  touch: `lift the [second finger], and drag [${pushLevel}] to the left`,
  keys: 'press [−]',
  gamepad: 'release the [right trigger] a little',
};
const pressAgain: ByInput = {
  mouse: 'hold the [left button] again',
  touch: 'put the [second finger] down again',
  keys: 'hold [Space] again',
  gamepad: 'press the [right trigger] again',
};
const withdraw: ByInput = {
  mouse: 'hold the [right button]',
  touch: `hold [${withdrawButton}] below the picture`,
  keys: 'hold [B]',
  gamepad: 'hold the [left trigger]',
};
const aim: ByInput = {
  mouse: 'move the pointer until the orange dot is in the middle of the green ring',
  touch: 'move [one finger] on the picture until the orange dot is in the middle of the green ring',
  keys: 'press [Home] to bring the orange dot into the green ring',
  gamepad: 'move the [left stick] until the orange dot is in the middle of the green ring',
};

const sentence = (text: string) => `${text.charAt(0).toUpperCase()}${text.slice(1)}.`;
const sentences = (of: ByInput): ByInput => ({
  mouse: sentence(of.mouse),
  touch: sentence(of.touch),
  keys: sentence(of.keys),
  gamepad: sentence(of.gamepad),
});

/** What to do next. */
const todo = {
  look: (): ByInput => ({
    mouse: 'Hold [Ctrl] and drag with the [left button] to rotate the picture. Then hold [Ctrl] and turn the [wheel].',
    touch: `Tap [${viewSide}] in the picture, then [${viewPlan}].`,
    keys: 'Hold [Ctrl] and press [←] until the picture has rotated. Then press [Page up].',
    gamepad: `Click [${viewSide}] in the picture, then [${viewPlan}].`,
  }),
  aim: () => sentences(aim),
  spindle: (): ByInput => ({
    mouse: `Press [${spindleOff}] below the picture, and [${irrigationButton}] beside it.`,
    touch: `Tap [${spindleOff}] below the picture, and [${irrigationButton}] beside it.`,
    keys: 'Press [S] to start the spindle, and [I] to irrigate.',
    gamepad: `Press [A] to start the spindle, and click [${irrigationButton}] below the picture.`,
  }),
  touch: (): ByInput => ({
    mouse: 'Aim at the green ring and hold the [left button] until the reamer touches the bone.',
    touch:
      'Keep [one finger] in the green ring and hold a [second finger] on the picture until the reamer touches the bone.',
    keys: 'Hold [Space] until the reamer touches the bone.',
    gamepad: 'Press the [right trigger] lightly until the reamer touches the bone.',
  }),
  press: (): ByInput => ({
    mouse: 'Keep holding the [left button] and turn the [wheel] up until the thrust is in the band. Stay in the ring.',
    touch: `Drag [${pushLevel}] below the picture to 52 N, then hold both fingers in the picture again.`,
    keys: 'Keep holding [Space] and press [+] until the thrust is in the band.',
    gamepad: 'Press the [right trigger] until the thrust is in the band. Stay in the ring.',
  }),
  stop: (planned: string): ByInput => ({
    mouse: `Watch the depth, and release the [left button] at ${planned} mm.`,
    touch: `Watch the depth, and lift the [second finger] at ${planned} mm.`,
    keys: `Watch the depth, and release [Space] at ${planned} mm.`,
    gamepad: `Watch the depth, and release the [right trigger] at ${planned} mm.`,
  }),
  withdraw: (): ByInput => ({
    mouse: `${sentence(withdraw.mouse).slice(0, -1)} until the reamer is free. Keep the spindle turning.`,
    touch: `${sentence(withdraw.touch).slice(0, -1)} until the reamer is free. Keep the spindle turning.`,
    keys: `${sentence(withdraw.keys).slice(0, -1)} until the reamer is free. Keep the spindle turning.`,
    gamepad: `${sentence(withdraw.gamepad).slice(0, -1)} until the reamer is free. Keep the spindle turning.`,
  }),
  result: (): ByInput => ({
    mouse: `Press [${stop}] below, then read your result.`,
    touch: `Tap [${stop}] below, then read your result.`,
    keys: `Press [Shift]+[Tab] until ${stop} has a frame. Then press [Enter] and read your result.`,
    gamepad: `Click [${stop}] below, then read your result.`,
  }),
};

const why = {
  look: `The reamer hides what it cuts. From the side you can see it. The button ${viewPlan} returns to this view.`,
  aim: 'The green ring marks the planned entry. Bone that you cut beside it does not come back.',
  spindle: 'If you press before the reamer turns, it can catch. Without saline, the bone gets too warm.',
  touch: `${pushLevel} is set low, so that you reach the bone gently.`,
  press:
    'On the gauge, the band is the target thrust and the marker is your thrust. A mean of 35 to 70 N gets full points.',
  stop: 'Bone that you cut too deep does not come back. You can always cut more later.',
  withdraw: 'A turning reamer comes free easily. A stopped reamer can catch.',
  result: 'The result shows how close to the plan you are, and how you worked.',
};

const done = {
  look: 'You have looked around.',
  aim: 'The reamer is on the planned axis.',
  spindle: 'The spindle turns, and saline flows.',
  touch: 'The reamer touches the bone.',
  press: 'The thrust is right.',
  stop: 'The planned depth is reached.',
  withdraw: 'The reamer is free.',
  result: 'The session has ended.',
};

const strayed = {
  tooDeep: () => `You are more than 0.3 mm past the plan. Press [${again}] to get the same case with intact bone.`,
  endedEarly: () => `The session ended before the last step. Press [${again}] for a new session.`,
  notInHand: () => `You are not controlling the reamer. Press [${takeOver}].`,
  tooEarly: (input: InputKind) =>
    `The reamer is already on the bone. First ${release[input]}, then ${withdraw[input]} for a moment.`,
  stalled: (input: InputKind) => `The spindle has stalled. First ${withdraw[input]} for a moment, then press less.`,
  spindleOff: (input: InputKind) => `The spindle is off. Stop pushing, then ${startSpindle[input]}.`,
  offAxis: (input: InputKind) => `The reamer is off the plan or tilted. First ${release[input]}, then ${aim[input]}.`,
  tooHard: (input: InputKind) => `You are pressing too hard. To press less, ${pressLess[input]}.`,
  tooShallow: (input: InputKind) => `You stopped before the planned depth. To continue, ${pressAgain[input]}.`,
  pressesOn: (input: InputKind) =>
    `Planned depth reached: stop pressing. First ${release[input]}, then ${withdraw[input]}.`,
};

export const tutorialText = {
  tutorial: 'Tutorial',
  hint: 'Your first reaming, step by step. Takes about ten minutes.',
  offer: 'New here? The tutorial guides you through your first reaming.',
  notNow: 'Not now',
  progress: (step: number, of: number) => `Step ${step} of ${of}`,
  progressDone: 'All steps done',
  stepDone: 'done',
  skip: 'Skip tutorial',
  skipHint: 'The session continues. You can open the tutorial again beside Practise. (Esc)',
  again,
  againHint: 'Starts a new session on the same case with intact bone. The current session ends and is saved.',
  againOwnHint: 'Starts your own session on the same case. The current session continues.',
  close: 'Close',
  review: 'Review this session',
  todo,
  why,
  done,
  strayed,
  closing: (depth: string, planned: string) =>
    `You have reamed the demo to the planned depth: ${depth} of ${planned} mm.`,
  closingWhy: 'The result is beside or below the picture. The review shows what to improve next time.',
  depth: 'Depth',
  thrust: 'Thrust',
  beside: 'Distance from plan',
  wanted: (from: string, to: string, unit: string) => `target: ${from} to ${to} ${unit}`,
};
