import { computed, type ReadonlySignal } from '@preact/signals';

import type { Latency } from './latency';
import type { PracticeStore } from './practice_store';
import type { Store } from './store';

export type HealthState = 'ok' | 'slow' | 'lost';
/** What is behind it: who is too slow, or what does not answer. */
export type HealthCause = 'server' | 'network' | 'picture' | 'stream' | 'hand' | 'version';
export type Health = { state: 'ok'; cause: null } | { state: 'slow' | 'lost'; cause: HealthCause };

/** A share of missed ticks above this is worth saying, percent. */
const lateAbovePercent = 0.1;
/** What the picture should take at most, ms; and below what it counts as quick again, so that the state rests. */
const slowFromMs = 100;
const quickBelowMs = 80;

/** Of so many ticks; null while there are none. */
export function missedPercent(missed: number | null, ticks: number): number | null {
  return missed === null || ticks === 0 ? null : (missed / ticks) * 100;
}

export const isLate = (percent: number | null): boolean => percent !== null && percent > lateAbovePercent;

/** Of the ticks of the watched session, or null while that is not known. */
export function missedHere(store: Store): number | null {
  const details = store.details.value;
  const session = details !== null && details.id === store.sessionId.value ? details : null;
  const telemetry = store.reading.value.telemetry;
  return missedPercent(telemetry?.ticksMissed ?? session?.loop.missed ?? null, telemetry?.tick ?? session?.tick ?? 0);
}

/** How late the picture is, of a hand on this page or of what is watched; null while that is not known. */
export function pictureDelayMs(store: Store, practice: PracticeStore, latency: Latency): number | null {
  if (!store.live.value) return null;
  if (practice.steering.value) return latency.handMs.value;
  const drawingMs = latency.drawingMs.value;
  return drawingMs === null ? null : drawingMs + store.reading.value.behindMs;
}

/** Whether the simulation keeps up, as far as somebody before it needs to know; null: there is none to see. */
export function healthHere(store: Store, practice: PracticeStore, latency: Latency): ReadonlySignal<Health | null> {
  let wasSlow = false;
  return computed((): Health | null => {
    const lost = whatIsLost(store, practice);
    if (lost !== null) return { state: 'lost', cause: lost };
    if (store.link.value.kind !== 'live') return null;
    const delayMs = pictureDelayMs(store, practice, latency);
    wasSlow = delayMs !== null && delayMs > (wasSlow ? quickBelowMs : slowFromMs);
    const slow = whatIsSlow(store, practice, wasSlow);
    return slow === null ? { state: 'ok', cause: null } : { state: 'slow', cause: slow };
  });
}

function whatIsLost(store: Store, practice: PracticeStore): HealthCause | null {
  const link = store.link.value.kind;
  if (link === 'refused') return 'version';
  // A server that still prepares says so itself.
  if (link === 'silent' || (link === 'lost' && store.hasPicture.value)) return 'stream';
  const hand = practice.link.value.kind;
  return practice.steering.value && (hand === 'lost' || hand === 'silent') ? 'hand' : null;
}

function whatIsSlow(store: Store, practice: PracticeStore, slowPicture: boolean): HealthCause | null {
  if (store.farBehind.value) return 'network';
  // What has ended cannot be late.
  if (!store.active.value) return null;
  if (isLate(missedHere(store))) return 'server';
  if (!slowPicture || store.replaying.value) return null;
  const awayMs = practice.steering.value ? (practice.feedback.value?.rttMs ?? 0) : store.reading.value.behindMs;
  return awayMs > slowFromMs / 2 ? 'network' : 'picture';
}
