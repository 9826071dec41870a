import { signal } from '@preact/signals';

/** What somebody steers with. */
export type InputKind = 'mouse' | 'touch' | 'keys' | 'gamepad';

/** A mouse that is only knocked against does not count, pixels. */
const knockPx = 24;
/** Held with a mouse, too. */
const modifiers = new Set(['Control', 'Shift', 'Alt', 'Meta', 'Escape']);

type Target = Pick<Window, 'addEventListener'>;

/** Which input was used last, so that words can name the key or the gesture that is at hand. */
export class LastInput {
  readonly kind = signal<InputKind>('mouse');
  private movedPx = 0;

  /** `coarse`: what points is a finger, as far as is known before anything was used. */
  listen(target: Target, coarse: boolean): void {
    if (coarse) this.kind.value = 'touch';
    const options = { capture: true, passive: true };
    const take = (kind: InputKind) => this.take(kind);
    target.addEventListener('pointerdown', (event) => take(event.pointerType === 'touch' ? 'touch' : 'mouse'), options);
    target.addEventListener('pointermove', (event) => this.onMove(event), options);
    target.addEventListener('wheel', () => take('mouse'), options);
    target.addEventListener('keydown', (event) => this.onKey(event), options);
  }

  /** Somebody did something with it. */
  take(kind: InputKind): void {
    this.movedPx = 0;
    this.kind.value = kind;
  }

  private onMove(event: PointerEvent): void {
    if (event.pointerType === 'touch') return;
    this.movedPx += Math.abs(event.movementX) + Math.abs(event.movementY);
    if (this.movedPx > knockPx) this.take('mouse');
  }

  private onKey(event: KeyboardEvent): void {
    if (!modifiers.has(event.key) && !event.repeat) this.take('keys');
  }
}
