import { computed, signal } from '@preact/signals';

import { Hand } from '../practice/hand';
import { LastInput } from '../practice/last_input';
import { type LevelName, levels } from '../practice/level';
import { PlanFrame } from '../practice/plan_frame';
import type { Feedback } from '../wire/device_messages';
import type { DeviceLinkState } from '../wire/device_link';
import type { Store } from './store';

/** What the page knows of the session that is steered here. Written by the practice and the hand, read by panels. */
export class PracticeStore {
  readonly hand = new Hand();
  /** What the person used last. */
  readonly input = new LastInput();
  /** The session that this page steers. */
  readonly sessionId = signal<string | null>(null);
  /** The one that it steered last. */
  readonly lastSessionId = signal<string | null>(null);
  /** How much is given in the session that is, or was last, steered. */
  readonly level = signal<LevelName>('guided');
  readonly link = signal<DeviceLinkState>({ kind: 'connecting' });
  /** What the server last answered; null while nothing is known. */
  readonly feedback = signal<Feedback | null>(null);
  /** A gamepad is there. */
  readonly gamepad = signal(false);

  /** The plan of the steered session, once its picture is there. */
  readonly plan = computed(() => {
    const hello = this.store.hello.value;
    if (hello === null || this.sessionId.value !== hello.sessionId || this.store.replaying.value) return null;
    return new PlanFrame(hello);
  });
  readonly steering = computed(() => this.plan.value !== null);
  /** Whether the page says what to do: always to who only watches. */
  readonly hints = computed(() => this.sessionId.value === null || levels[this.level.value].hints);
  /** How far the aim is from the planned axis, mm. */
  readonly offPlanMm = computed(() => Math.hypot(this.hand.place.value.superior, this.hand.place.value.anterior));

  constructor(private readonly store: Store) {}
}
