import { computed, effect, signal } from '@preact/signals';

import type { Telemetry } from '../wire/messages';
import type { Store } from './store';

/** Mean thrust of the surgeons in Faieghi's cadaver experiments (thesis, chapter 5), N. */
export const usualThrustN = 52;
/** From 1.5 times that a push counts as excess, from twice as far too hard. */
export const excessThrustN = 1.5 * usualThrustN;
export const extremeThrustN = 2 * usualThrustN;
/** Within this of the plan the depth counts as reached, mm; from the other on it is far past. */
export const reachedWithinMm = 0.05;
export const farPastMm = 1;
/** From the first on bone dies within a minute, from the other on at once (Eriksson & Albrektsson). */
export const warmC = 47;
export const hotC = 56;

const holdsTicks = 1500;
/** Older entries of a batch are history, which a jump of a replay sends first. */
const freshTicks = 250;
const bounceTicks = 500;
/** More than this is felt only on bone, N. */
const onBoneN = 1;

export interface Alarm {
  kind: 'thrust' | 'depth' | 'heat';
  level: 'warn' | 'bad';
  /** The greatest of the last moments, N, mm or degrees Celsius. */
  value: number;
}

/** The greatest of a batch, without its history. */
function mostThrustN({ tick, firstTick, tickStride, thrustN }: Telemetry): number {
  let newtons = 0;
  thrustN.forEach((value, i) => {
    if (tick - (firstTick + i * tickStride) <= freshTicks) newtons = Math.max(newtons, value);
  });
  return newtons;
}

/** Excess thrust is shown a while longer than it lasts, so that it can be read. Ticks are those of the session. */
export class ThrustWatch {
  private peaks: { tick: number; newtons: number }[] = [];

  /** The greatest excess of the last moments, or null. */
  take(telemetry: Telemetry): number | null {
    const { tick } = telemetry;
    const newtons = mostThrustN(telemetry);
    this.peaks = this.peaks.filter((peak) => peak.tick <= tick && tick - peak.tick < holdsTicks);
    if (newtons > excessThrustN) this.peaks.push({ tick, newtons });
    return this.peaks.length === 0 ? null : Math.max(...this.peaks.map((peak) => peak.newtons));
  }

  clear(): void {
    this.peaks = [];
  }
}

/**
 * Whether the reamer is on bone; one that bounces while it cuts counts as being there. By the thrust too, since studies
 * of feel hide the density. Ticks are those of the session.
 */
export class TouchWatch {
  private lastTick: number | null = null;

  take(telemetry: Telemetry): boolean {
    const { tick, densityGCc } = telemetry;
    if (densityGCc > 0 || mostThrustN(telemetry) > onBoneN) this.lastTick = tick;
    return this.lastTick !== null && this.lastTick <= tick && tick - this.lastTick < bounceTicks;
  }

  clear(): void {
    this.lastTick = null;
  }
}

/** Past the plan, or null. */
export function pastPlanMm(depthMm: number, plannedMm: number): number | null {
  const pastMm = depthMm - plannedMm;
  return plannedMm > 0 && pastMm > reachedWithinMm ? pastMm : null;
}

/** How bad it is for bone to be as warm as this. */
export function heatLevel(surfaceC: number | null): Alarm['level'] | null {
  if (surfaceC === null || surfaceC < warmC) return null;
  return surfaceC < hotC ? 'warn' : 'bad';
}

/** Always the same, so that nothing follows from there being none still. */
const none: readonly Alarm[] = [];

/** What the person at the reamer should stop doing. Nothing while what is known is not of this moment. */
export class Alarms {
  private readonly thrustN = signal<number | null>(null);
  private readonly touching = signal(false);
  readonly now = computed((): readonly Alarm[] => (this.store.upToDate.value ? this.all() : none));

  constructor(private readonly store: Store) {
    const watch = new ThrustWatch();
    const touch = new TouchWatch();
    let session = '';
    effect(() => {
      const of = `${store.hello.value?.sessionId ?? ''} ${store.playback.value?.jump ?? ''}`;
      if (of !== session) {
        watch.clear();
        touch.clear();
      }
      session = of;
      const telemetry = store.telemetry.value;
      this.touching.value = telemetry !== null && touch.take(telemetry);
      this.thrustN.value = telemetry === null ? null : watch.take(telemetry);
    });
  }

  private all(): readonly Alarm[] {
    const found: Alarm[] = [];
    const newtons = this.thrustN.value;
    const moving = this.store.moving.value;
    if (newtons !== null && moving)
      found.push({ kind: 'thrust', level: newtons > extremeThrustN ? 'bad' : 'warn', value: newtons });
    const { telemetry, hello } = this.store;
    const pastMm = pastPlanMm(telemetry.value?.depthMm ?? NaN, hello.value?.plannedDepthMm ?? 0);
    // The bone stays gone: what is told is to stop and to withdraw, until that is done.
    if (pastMm !== null && moving && this.touching.value)
      found.push({ kind: 'depth', level: pastMm > farPastMm ? 'bad' : 'warn', value: pastMm });
    const surfaceC = telemetry.value?.surfaceTemperatureC ?? null;
    const heat = heatLevel(surfaceC);
    if (surfaceC !== null && heat !== null && moving) found.push({ kind: 'heat', level: heat, value: surfaceC });
    return found.length === 0 ? none : found;
  }
}
