import type { PicturePoint } from '../ct/slice_layout';

/** What pointer, wheel and keys do in a slice; places are in px of the picture. */
export interface SliceActions {
  /** Whether a mark that may be dragged is under the place; if so it is the one that is moved from here on. */
  takeHold(at: PicturePoint): boolean;
  moveHeld(at: PicturePoint): void;
  letGo(): void;
  /** Press and release in one place, where something is held or to be placed. */
  click(at: PicturePoint): void;
  crossHairTo(at: PicturePoint): void;
  /** Whether a press is first of all a click that places something. */
  placing(): boolean;
  pan(rightPx: number, downPx: number): void;
  zoom(at: PicturePoint, factor: number): void;
  scroll(slices: number): void;
  window(widthHu: number, levelHu: number): void;
  hover(at: PicturePoint | null): void;
}

const clickWithinPx = 4;
/** From here a turn of the wheel is one of its notches; trackpads come in smaller steps, which are added up. */
const notchPx = 50;
const wheelPxPerSlice = 30;
const huPerPx = 4;

type Drag = 'crossHair' | 'held' | 'pan' | 'window' | 'clickOrCrossHair' | 'clickOrHeld';

/** One or two fingers, a mouse and its wheel on one slice. */
export class SliceInput {
  private drag: Drag | null = null;
  private readonly fingers = new Map<number, PicturePoint>();
  private start: PicturePoint = { x: 0, y: 0 };
  private wheelPx = 0;

  constructor(
    private readonly surface: HTMLElement,
    private readonly actions: SliceActions,
  ) {
    surface.addEventListener('pointerdown', (event) => this.onDown(event));
    surface.addEventListener('pointermove', (event) => this.onMove(event));
    surface.addEventListener('pointerup', (event) => this.onUp(event));
    surface.addEventListener('pointercancel', (event) => this.onUp(event));
    surface.addEventListener('pointerleave', () => actions.hover(null));
    surface.addEventListener('wheel', (event) => this.onWheel(event), { passive: false });
    surface.addEventListener('contextmenu', (event) => event.preventDefault());
  }

  private at(event: MouseEvent): PicturePoint {
    const box = this.surface.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  private onDown(event: PointerEvent): void {
    const at = this.at(event);
    this.surface.focus({ preventScroll: true });
    this.surface.setPointerCapture(event.pointerId);
    this.fingers.set(event.pointerId, at);
    if (this.fingers.size === 2) {
      this.letGo();
      this.drag = null;
      return;
    }
    this.start = at;
    if (event.button === 1 || (event.button === 0 && event.shiftKey)) this.drag = 'pan';
    else if (event.button === 2) this.drag = 'window';
    else if (event.button !== 0) this.drag = null;
    else if (this.actions.takeHold(at)) this.drag = 'clickOrHeld';
    else if (this.actions.placing()) this.drag = 'clickOrCrossHair';
    else {
      this.drag = 'crossHair';
      this.actions.crossHairTo(at);
    }
    if (event.button === 1) event.preventDefault();
  }

  private onMove(event: PointerEvent): void {
    const at = this.at(event);
    const before = this.fingers.get(event.pointerId);
    if (before === undefined) {
      this.actions.hover(at);
      return;
    }
    if (this.fingers.size === 2) this.pinch(event.pointerId, before, at);
    this.fingers.set(event.pointerId, at);
    if (this.fingers.size > 1) return;
    const far = Math.hypot(at.x - this.start.x, at.y - this.start.y) > clickWithinPx;
    if (this.drag === 'clickOrCrossHair' && far) this.drag = 'crossHair';
    if (this.drag === 'clickOrHeld' && far) this.drag = 'held';
    if (this.drag === 'crossHair') this.actions.crossHairTo(at);
    if (this.drag === 'held') this.actions.moveHeld(at);
    if (this.drag === 'pan') this.actions.pan(at.x - before.x, at.y - before.y);
    if (this.drag === 'window') this.actions.window((at.x - before.x) * huPerPx, (at.y - before.y) * huPerPx);
  }

  private onUp(event: PointerEvent): void {
    this.fingers.delete(event.pointerId);
    const isClick = this.drag === 'clickOrCrossHair' || this.drag === 'clickOrHeld';
    if (isClick && event.type === 'pointerup') this.actions.click(this.at(event));
    this.letGo();
    this.drag = null;
  }

  private letGo(): void {
    if (this.drag === 'held' || this.drag === 'clickOrHeld') this.actions.letGo();
  }

  private pinch(moved: number, before: PicturePoint, now: PicturePoint): void {
    const other = [...this.fingers].find(([id]) => id !== moved)?.[1];
    if (other === undefined) return;
    const spread = (point: PicturePoint) => Math.max(Math.hypot(point.x - other.x, point.y - other.y), 1);
    this.actions.zoom({ x: (now.x + other.x) / 2, y: (now.y + other.y) / 2 }, spread(now) / spread(before));
    this.actions.pan((now.x - before.x) / 2, (now.y - before.y) / 2);
  }

  private onWheel(event: WheelEvent): void {
    event.preventDefault();
    const px = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? event.deltaY * 20 : event.deltaY;
    if (event.ctrlKey) {
      this.actions.zoom(this.at(event), Math.exp(-px / 300));
      return;
    }
    if (Math.abs(px) >= notchPx) {
      this.wheelPx = 0;
      this.actions.scroll(Math.sign(px));
      return;
    }
    this.wheelPx += px;
    const slices = Math.trunc(this.wheelPx / wheelPxPerSlice);
    this.wheelPx -= slices * wheelPxPerSlice;
    if (slices !== 0) this.actions.scroll(slices);
  }
}
