import type { Hand } from './hand';
import type { Beside } from './plan_frame';

/** A stick rests within this. */
const deadZone = 0.14;
const placeMmPerS = 14;
const leanDegPerS = 14;
/** Buttons of the standard layout. */
const [spindleButton, pauseButton, withdrawTrigger, pushTrigger] = [0, 1, 6, 7];

/** What of a `Gamepad` is used. */
export interface PadState {
  axes: readonly number[];
  buttons: readonly { pressed: boolean; value: number }[];
}

/** Right and up on the picture as directions beside the plan. */
export interface ScreenAxes {
  right: Beside;
  up: Beside;
}

/**
 * A gamepad as a hand: the left stick moves the tool over the bone, the right one leans it, the right trigger pushes, the
 * left one withdraws, the first button is the spindle's, the second rests the session.
 */
export class GamepadHand {
  private pressedBefore: boolean[] = [];

  constructor(private readonly hand: Hand) {}

  /** To be called at every step while practising; null: none is there. Whether the person did something. */
  step(pad: PadState | null, seconds: number, screen: ScreenAxes): boolean {
    this.hand.push('gamepad', pad?.buttons[pushTrigger]?.value ?? 0);
    this.hand.withdraw('gamepad', pad?.buttons[withdrawTrigger]?.value ?? 0);
    if (pad === null) return false;
    const moved = this.stick(pad, 0, placeMmPerS * seconds, screen);
    if (moved !== null) this.hand.putAt(sum(this.hand.place.value, moved), true);
    const leant = this.stick(pad, 2, leanDegPerS * seconds, screen);
    if (leant !== null) this.hand.leanTo(sum(this.hand.lean.value, leant));
    if (this.newlyPressed(pad, spindleButton)) this.hand.toggleSpindle();
    if (this.newlyPressed(pad, pauseButton)) this.hand.togglePause();
    this.pressedBefore = pad.buttons.map((button) => button.pressed);
    return moved !== null || leant !== null || pad.buttons.some((button) => button.pressed || button.value > deadZone);
  }

  /** How far a stick moves things in this step; null while it rests. Fine near the middle, fast at the rim. */
  private stick(pad: PadState, firstAxis: number, most: number, screen: ScreenAxes): Beside | null {
    const x = pad.axes[firstAxis] ?? 0;
    const down = pad.axes[firstAxis + 1] ?? 0;
    const deflection = Math.hypot(x, down);
    if (deflection < deadZone) return null;
    const speed = (Math.min((deflection - deadZone) / (1 - deadZone), 1) ** 2 * most) / deflection;
    return onScreen(screen, x * speed, -down * speed);
  }

  private newlyPressed(pad: PadState, button: number): boolean {
    return (pad.buttons[button]?.pressed ?? false) && !(this.pressedBefore[button] ?? false);
  }
}

/** A motion on the picture as one beside the plan. */
export function onScreen(screen: ScreenAxes, right: number, up: number): Beside {
  return {
    superior: screen.right.superior * right + screen.up.superior * up,
    anterior: screen.right.anterior * right + screen.up.anterior * up,
  };
}

export function sum(a: Beside, b: Beside): Beside {
  return { superior: a.superior + b.superior, anterior: a.anterior + b.anterior };
}
