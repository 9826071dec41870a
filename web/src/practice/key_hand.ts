import { onScreen, sum } from './gamepad_hand';
import { levelStepN, type Hand } from './hand';
import type { PlanFrame } from './plan_frame';
import type { SteeredView } from './pointer_hand';

const placeMmPerS = 8;
const leanDegPerS = 10;
const turnPx = 24;
const zoomPerPress = 1.1;

type Arrow = 'ArrowLeft' | 'ArrowRight' | 'ArrowUp' | 'ArrowDown';
const arrows: Record<Arrow, readonly [right: number, up: number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/**
 * Keys while the picture has the focus: arrows place the tool, with Shift they lean it, with Ctrl they turn the view;
 * space pushes, B or Backspace withdraws, S is the spindle, I irrigates, P rests the session, plus and minus change how hard a push is,
 * Page up and Page down zoom, Home puts the tool back onto the plan.
 */
export class KeyHand {
  private readonly down = new Map<Arrow, 'place' | 'lean'>();

  constructor(
    surface: Pick<HTMLElement, 'addEventListener'>,
    private readonly hand: Hand,
    private readonly view: SteeredView,
    private readonly plan: () => PlanFrame | null,
  ) {
    surface.addEventListener('keydown', (event) => {
      if (this.plan() !== null && !event.altKey && !event.metaKey && this.onDown(event)) event.preventDefault();
    });
    surface.addEventListener('keyup', (event) => this.onUp(event));
    surface.addEventListener('blur', () => this.releaseAll());
  }

  /** Moves what held arrows move. */
  step(seconds: number): void {
    const plan = this.plan();
    if (plan === null || this.down.size === 0) return;
    const screen = this.view.screenAxes(plan);
    for (const [arrow, what] of this.down) {
      const [right, up] = arrows[arrow];
      if (what === 'place') {
        const by = onScreen(screen, right * placeMmPerS * seconds, up * placeMmPerS * seconds);
        this.hand.putAt(sum(this.hand.place.value, by), true);
      } else {
        const by = onScreen(screen, right * leanDegPerS * seconds, up * leanDegPerS * seconds);
        this.hand.leanTo(sum(this.hand.lean.value, by));
      }
    }
  }

  /** Whether the key is one of the hand's. */
  private onDown(event: KeyboardEvent): boolean {
    if (isArrow(event.key)) return this.onArrow(event, event.key);
    if (event.ctrlKey) return false;
    if (event.key === 'PageUp' || event.key === 'PageDown') {
      this.view.zoomBy(event.key === 'PageUp' ? 1 / zoomPerPress : zoomPerPress);
      return true;
    }
    const action = this.action(event.key);
    if (action === null) return false;
    this.hand.takeHold();
    if (!event.repeat || event.key === '+' || event.key === '=' || event.key === '-') action();
    return true;
  }

  private action(key: string): (() => void) | null {
    const { hand } = this;
    switch (key) {
      case ' ':
        return () => hand.push('keys', 1);
      case 'b':
      case 'B':
      case 'Backspace':
        return () => hand.withdraw('keys', 1);
      case 's':
      case 'S':
        return () => hand.toggleSpindle();
      case 'i':
      case 'I':
        return () => hand.toggleIrrigation();
      case 'p':
      case 'P':
        return () => hand.togglePause();
      case '+':
      case '=':
        return () => hand.changeLevel(levelStepN);
      case '-':
        return () => hand.changeLevel(-levelStepN);
      case 'Home':
        return () => hand.goHome();
      default:
        return null;
    }
  }

  private onArrow(event: KeyboardEvent, arrow: Arrow): boolean {
    if (event.ctrlKey) {
      const [right, up] = arrows[arrow];
      this.view.turnBy(-right * turnPx, up * turnPx);
      return true;
    }
    this.hand.takeHold();
    this.down.set(arrow, event.shiftKey ? 'lean' : 'place');
    return true;
  }

  private onUp(event: KeyboardEvent): void {
    if (isArrow(event.key)) this.down.delete(event.key);
    else if (event.key === ' ') this.hand.push('keys', 0);
    else if (event.key === 'b' || event.key === 'B' || event.key === 'Backspace') this.hand.withdraw('keys', 0);
  }

  private releaseAll(): void {
    this.down.clear();
    this.hand.push('keys', 0);
    this.hand.withdraw('keys', 0);
  }
}

function isArrow(key: string): key is Arrow {
  return key in arrows;
}
