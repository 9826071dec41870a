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
  mouse: 'let go of the [left button]',
  touch: 'lift the [second finger]',
  keys: 'let go of [Space]',
  gamepad: 'let go of the [right trigger]',
};
const pressLess: ByInput = {
  mouse: 'turn the [wheel] down',
  touch: `lift the [second finger], and drag [${pushLevel}] to the left`,
  keys: 'press [−]',
  gamepad: 'let the [right trigger] up a little',
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
    mouse: 'Hold [Ctrl] and drag with the [left button] to turn the picture, then hold [Ctrl] and turn the [wheel].',
    touch: `Tap [${viewSide}] in the picture, then [${viewPlan}].`,
    keys: 'Hold [Ctrl] and press [←] until the picture has turned, then press [Page up].',
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
    mouse: 'Keep the [left button] held and turn the [wheel] up until the thrust is in the band; stay in the ring.',
    touch: `Drag [${pushLevel}] below the picture to 52 N, then hold both fingers in the picture again.`,
    keys: 'Keep [Space] held and press [+] until the thrust is in the band.',
    gamepad: 'Press the [right trigger] until the thrust is in the band; stay in the ring.',
  }),
  stop: (planned: string): ByInput => ({
    mouse: `Watch the depth, and let go of the [left button] at ${planned} mm.`,
    touch: `Watch the depth, and lift the [second finger] at ${planned} mm.`,
    keys: `Watch the depth, and let go of [Space] at ${planned} mm.`,
    gamepad: `Watch the depth, and let go of the [right trigger] at ${planned} mm.`,
  }),
  withdraw: (): ByInput => ({
    mouse: `${sentence(withdraw.mouse).slice(0, -1)} until the reamer is free; let the spindle turn.`,
    touch: `${sentence(withdraw.touch).slice(0, -1)} until the reamer is free; let the spindle turn.`,
    keys: `${sentence(withdraw.keys).slice(0, -1)} until the reamer is free; let the spindle turn.`,
    gamepad: `${sentence(withdraw.gamepad).slice(0, -1)} until the reamer is free; let the spindle turn.`,
  }),
  result: (): ByInput => ({
    mouse: `Press [${stop}] below, then read your result.`,
    touch: `Tap [${stop}] below, then read your result.`,
    keys: `Press [Shift]+[Tab] until ${stop} is framed, then [Enter], and read your result.`,
    gamepad: `Click [${stop}] below, then read your result.`,
  }),
};

const why = {
  look: `The reamer hides what it cuts; from the side you see it. The button ${viewPlan} brings this view back.`,
  aim: 'The green ring is the planned place. What is cut beside it stays cut.',
  spindle: 'A reamer that is pressed before it turns can catch. Without saline the bone becomes too warm.',
  touch: `${pushLevel} is set low, so that you find the bone without a blow.`,
  press:
    'On the gauge the band is the wanted thrust, the mark is yours. The score gives all points for a mean of 35 to 70 N.',
  stop: 'Bone that is cut too deep does not come back. What is left can still be cut.',
  withdraw: 'A reamer that turns comes free by itself; one that stands can catch.',
  result: 'The result says how near to the plan you came, and how you got there.',
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
  tooDeep: () =>
    `You have gone more than 0.3 mm past the plan, and that bone does not come back. Press ${again}: the same case, with intact bone.`,
  endedEarly: () => `The session ended before the last step. Press ${again} for a new one.`,
  notInHand: () => `The reamer is not in your hand. Take it back with [${takeOver}].`,
  tooEarly: (input: InputKind) =>
    `The reamer is on the bone already. First ${release[input]}, then ${withdraw[input]} a moment.`,
  stalled: (input: InputKind) => `The bone holds the reamer. First ${withdraw[input]} a moment, then press less.`,
  spindleOff: (input: InputKind) => `The spindle does not turn. Do not press; ${startSpindle[input]} first.`,
  offAxis: (input: InputKind) =>
    `The reamer stands beside the plan, or leans. First ${release[input]}, then ${aim[input]}.`,
  tooHard: (input: InputKind) => `You press too hard. To press less, ${pressLess[input]}.`,
  tooShallow: (input: InputKind) => `You have let go before the planned depth. To go on, ${pressAgain[input]}.`,
  pressesOn: (input: InputKind) =>
    `You press on, and the plan is reached. First ${release[input]}, then ${withdraw[input]}.`,
};

export const tutorialText = {
  tutorial: 'Tutorial',
  hint: 'A first reaming of the demo, step by step; about ten minutes.',
  offer: 'New here? The tutorial takes you through a first reaming, step by step.',
  notNow: 'Not now',
  progress: (step: number, of: number) => `Step ${step} of ${of}`,
  progressDone: 'All steps done',
  stepDone: 'done',
  skip: 'Skip tutorial',
  skipHint: 'You keep the reamer. The tutorial stays at hand beside Practise. (Esc)',
  again,
  againHint: 'A new session on the same case, with intact bone. This one ends and is kept.',
  againOwnHint: 'A new session of your own on the same case. This one goes on.',
  close: 'Close',
  review: 'Review this session',
  todo,
  why,
  done,
  strayed,
  closing: (depth: string, planned: string) => `You have reamed the demo to its plan: ${depth} of ${planned} mm.`,
  closingWhy: 'The result stands beside or below the picture; the review says what to do better next time.',
  depth: 'Depth',
  thrust: 'Thrust',
  beside: 'Beside the plan',
  wanted: (from: string, to: string, unit: string) => `wanted: ${from} to ${to} ${unit}`,
};
