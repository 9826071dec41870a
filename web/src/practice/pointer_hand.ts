import { onScreen, type ScreenAxes, sum } from './gamepad_hand';
import { levelStepN, type Hand } from './hand';
import type { PlanFrame, Ray } from './plan_frame';

/** What of the picture the hand needs. */
export interface SteeredView {
  /** The line of sight under a place of the window. */
  rayAt(clientX: number, clientY: number): Ray;
  screenAxes(plan: PlanFrame): ScreenAxes;
  /** Turns the view by a drag, pixels. */
  turnBy(rightPx: number, downPx: number): void;
  zoomBy(factor: number): void;
}

/** What of the picture's element is used. */
export type PointerSurface = Pick<HTMLElement, 'addEventListener' | 'setPointerCapture' | 'getBoundingClientRect'>;

const leanDegPerPx = 0.15;
const zoomPerNotch = 1.1;
const [leftButton, middleButton, rightButton] = [0, 1, 2];

/** A button's bit in `buttons`. */
const bitOf = [1, 4, 2];

type Drag = 'turn' | 'lean';

/**
 * Mouse, pen and touch on the picture. The pointer places the tool; the left button pushes, the right one (or Shift and
 * the left one) withdraws; Ctrl or the middle button turns the view, Alt leans the tool; the wheel changes how hard a push
 * is. The first finger places, a second one pushes while it is down.
 */
export class PointerHand {
  private drag: Drag | null = null;
  private last = { x: 0, y: 0 };
  /** The button that pushes or withdraws, as in `buttons`; 0: none. */
  private pressing = 0;
  private readonly fingers: number[] = [];

  /** `plan` is null while nothing is practised: then the events are left to others. */
  constructor(
    private readonly surface: PointerSurface,
    private readonly hand: Hand,
    private readonly view: SteeredView,
    private readonly plan: () => PlanFrame | null,
  ) {
    const on = <K extends keyof HTMLElementEventMap>(type: K, handle: (event: HTMLElementEventMap[K]) => void) =>
      surface.addEventListener(
        type,
        (event) => {
          if (this.plan() !== null) handle(event);
        },
        { passive: false },
      );
    on('pointerdown', (event) => this.onDown(event));
    on('pointermove', (event) => this.onMove(event));
    on('pointerup', (event) => this.onUp(event));
    on('pointercancel', (event) => this.onUp(event));
    on('pointerleave', (event) => this.onLeave(event));
    on('wheel', (event) => this.onWheel(event));
    on('contextmenu', (event) => event.preventDefault());
  }

  private onDown(event: PointerEvent): void {
    this.hand.takeHold();
    this.last = { x: event.clientX, y: event.clientY };
    if (event.pointerType === 'touch') return this.onFinger(event);
    // Without this the middle button scrolls the page.
    if (event.button === middleButton) event.preventDefault();
    if (event.button === middleButton || (event.button === leftButton && (event.ctrlKey || event.metaKey)))
      return this.beginDrag('turn', event);
    if (event.button === leftButton && event.altKey) return this.beginDrag('lean', event);
    this.place(event, true);
    if (event.button === rightButton || (event.button === leftButton && event.shiftKey)) this.press('withdraw', event);
    else if (event.button === leftButton) this.press('push', event);
  }

  private onFinger(event: PointerEvent): void {
    this.fingers.push(event.pointerId);
    if (this.fingers.length === 1) this.place(event, true);
    else this.press('push', event);
  }

  private onMove(event: PointerEvent): void {
    const moved = { x: event.clientX - this.last.x, y: event.clientY - this.last.y };
    if (event.pointerType === 'touch') {
      if (event.pointerId === this.fingers[0]) this.place(event, true);
      return;
    }
    this.last = { x: event.clientX, y: event.clientY };
    // Of several buttons that are down only the last to go up has an event of its own.
    if ((event.buttons & this.pressing) !== this.pressing) this.release();
    if (this.drag === 'turn') this.view.turnBy(moved.x, moved.y);
    else if (this.drag === 'lean') this.leanBy(moved.x, moved.y);
    else if (this.pressing !== 0 && !this.within(event)) this.leave();
    else {
      this.hand.takeHold();
      this.place(event, this.pressing !== 0);
    }
  }

  private onUp(event: PointerEvent): void {
    const at = this.fingers.indexOf(event.pointerId);
    if (at >= 0) {
      this.fingers.splice(at, 1);
      // The second finger may not become the one that places: the tool would jump.
      if (at === 0) this.fingers.length = 0;
      if (this.fingers.length < 2) this.release();
      return;
    }
    if (event.pointerType === 'touch') return;
    this.drag = null;
    this.release();
  }

  private onLeave(event: PointerEvent): void {
    if (event.pointerType === 'touch' || this.drag !== null) return;
    if (this.pressing !== 0) this.leave();
    else this.hand.forgetHover();
  }

  /** The pointer has slipped off while it pressed. */
  private leave(): void {
    this.pressing = 0;
    this.hand.letGo();
  }

  private onWheel(event: WheelEvent): void {
    event.preventDefault();
    const notches = Math.sign(event.deltaY);
    if (event.ctrlKey) this.view.zoomBy(zoomPerNotch ** notches);
    else this.hand.changeLevel(-notches * levelStepN);
  }

  private beginDrag(drag: Drag, event: PointerEvent): void {
    this.drag = drag;
    this.surface.setPointerCapture(event.pointerId);
  }

  private leanBy(rightPx: number, downPx: number): void {
    const plan = this.plan();
    if (plan === null) return;
    const by = onScreen(this.view.screenAxes(plan), rightPx * leanDegPerPx, -downPx * leanDegPerPx);
    this.hand.leanTo(sum(this.hand.lean.value, by));
  }

  private place(event: PointerEvent, onPurpose: boolean): void {
    const plan = this.plan();
    if (plan === null) return;
    this.hand.putAt(plan.placeUnder(this.view.rayAt(event.clientX, event.clientY), this.hand.place.value), onPurpose);
  }

  private press(how: 'push' | 'withdraw', event: PointerEvent): void {
    this.pressing = event.pointerType === 'touch' ? 0 : (bitOf[event.button] ?? 0);
    if (how === 'push') this.hand.push('pointer', 1);
    else this.hand.withdraw('pointer', 1);
  }

  private release(): void {
    this.pressing = 0;
    this.hand.push('pointer', 0);
    this.hand.withdraw('pointer', 0);
  }

  private within(event: PointerEvent): boolean {
    const box = this.surface.getBoundingClientRect();
    return (
      event.clientX >= box.left && event.clientX <= box.right && event.clientY >= box.top && event.clientY <= box.bottom
    );
  }
}
