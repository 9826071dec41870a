import { signal, type Signal } from '@preact/signals';

import type { SteeringInput } from '../wire/device_messages';
import { leanMaxDeg, limited, sidewaysMaxMm, type Beside, type PlanFrame } from './plan_frame';
import type { StartPose } from './start_pose';

/** Force that a full push reaches, simulated N, as the person chooses it. */
export const levelLeastN = 4;
export const levelMostN = 120;
export const levelStepN = 4;
/** The thrust at which the feed of reamed bone was measured. */
const levelAtFirstN = 52;
/** A push rises no faster than this; it ends at once. */
const riseNPerS = 160;
/** A hand whose pressure is its own pushes harder the longer it pushes, and lets go as a hand does. */
const ownRiseNPerS = 25;
const ownFallNPerS = 60;
export const withdrawN = 20;

/** How a hand starts into a session. */
export interface HandStart {
  /** Null: on the plan. */
  pose: StartPose | null;
  ownPressure: boolean;
}
const givenAll: HandStart = { pose: null, ownPressure: false };

/**
 * What the person wants the simulated hand to do, gathered from mouse, touch, keys, buttons and gamepad: whichever moved
 * last places the tool, any of them may push, and one that withdraws wins.
 */
export class Hand {
  readonly place: Signal<Beside> = signal({ superior: 0, anterior: 0 });
  readonly lean: Signal<Beside> = signal({ superior: 0, anterior: 0 });
  readonly levelN = signal(levelAtFirstN);
  readonly pushN = signal(0);
  readonly spindleOn = signal(false);
  readonly irrigating = signal(false);
  readonly paused = signal(false);
  /** Somebody is at the tool; without that nothing is pushed and nothing turns. */
  readonly held = signal(true);

  private readonly pushes = new Map<string, number>();
  private readonly withdrawals = new Map<string, number>();
  /** Where the tool was put on purpose, not only in passing with the mouse. */
  private placedAt: Beside = { superior: 0, anterior: 0 };
  /** The plan has to be found: there is no key that leads back to it. */
  private findsPlan = false;
  private ownPressure = false;

  /**
   * A new session, everything off: over the plan, or where `pose` says. With a pressure of its own the hand decides by
   * the time that it pushes how hard.
   */
  reset({ pose, ownPressure }: HandStart = givenAll): void {
    this.letGo();
    this.findsPlan = pose !== null;
    this.ownPressure = ownPressure;
    this.place.value = this.placedAt = pose?.place ?? onPlan;
    this.lean.value = pose?.lean ?? onPlan;
    this.irrigating.value = false;
    this.paused.value = false;
    this.held.value = true;
  }

  /** Push by `share` (0 to 1) of the level, until the same `source` says 0. */
  push(source: string, share: number): void {
    setShare(this.pushes, source, share);
    if (share > 0) this.placedAt = this.place.value;
    const wantedN = this.wantedN();
    if (wantedN < 0 || (wantedN === 0 && !this.ownPressure)) this.pushN.value = wantedN;
  }

  withdraw(source: string, share: number): void {
    setShare(this.withdrawals, source, share);
    const wantedN = this.wantedN();
    if (wantedN < 0 || !this.ownPressure) this.pushN.value = Math.min(this.pushN.value, Math.max(wantedN, 0));
  }

  /** `onPurpose`: to stay there, also when the pointer leaves the picture. */
  putAt(place: Beside, onPurpose: boolean): void {
    this.place.value = limited(place, sidewaysMaxMm);
    if (onPurpose) this.placedAt = this.place.value;
  }

  /** The pointer only passed over the picture: back to where the tool was put. */
  forgetHover(): void {
    this.place.value = this.placedAt;
  }

  leanTo(lean: Beside): void {
    this.lean.value = limited(lean, leanMaxDeg);
  }

  /** Back onto the plan, unless it has to be found. */
  goHome(): void {
    if (this.findsPlan) return;
    this.putAt(onPlan, true);
    this.leanTo(onPlan);
  }

  changeLevel(byN: number): void {
    this.setLevel(this.levelN.value + byN);
  }

  setLevel(levelN: number): void {
    this.levelN.value = Math.min(Math.max(levelN, levelLeastN), levelMostN);
  }

  toggleSpindle(): void {
    this.spindleOn.value = !this.spindleOn.value;
  }

  toggleIrrigation(): void {
    this.irrigating.value = !this.irrigating.value;
  }

  togglePause(): void {
    this.paused.value = !this.paused.value;
    if (this.paused.value) this.stopPushing();
  }

  /** Nobody is at the tool any more: what pushed has to be pressed anew, and the spindle to be started anew. */
  letGo(): void {
    this.stopPushing();
    this.spindleOn.value = false;
    this.held.value = false;
  }

  takeHold(): void {
    this.held.value = true;
  }

  /** Lets the push rise towards what is wanted. */
  step(seconds: number): void {
    const wanted = this.wantedN();
    const now = Math.max(this.pushN.value, 0);
    if (wanted < 0 || (wanted === 0 && !this.ownPressure)) this.pushN.value = wanted;
    else if (wanted >= now)
      this.pushN.value = Math.min(wanted, now + (this.ownPressure ? ownRiseNPerS : riseNPerS) * seconds);
    else this.pushN.value = this.ownPressure ? Math.max(wanted, now - ownFallNPerS * seconds) : wanted;
  }

  input(plan: PlanFrame): SteeringInput {
    return {
      sidewaysMm: plan.sideways(this.place.value).toArray(),
      lean: plan.leant(this.lean.value).toArray(),
      pushN: this.pushN.value,
      spindleOn: this.spindleOn.value && this.held.value,
      irrigating: this.irrigating.value,
      paused: this.paused.value,
      held: this.held.value,
    };
  }

  private wantedN(): number {
    if (!this.held.value || this.paused.value) return 0;
    const back = Math.max(0, ...this.withdrawals.values());
    if (back > 0) return -back * withdrawN;
    return Math.max(0, ...this.pushes.values()) * (this.ownPressure ? levelMostN : this.levelN.value);
  }

  private stopPushing(): void {
    this.pushes.clear();
    this.withdrawals.clear();
    this.pushN.value = 0;
  }
}

const onPlan: Beside = { superior: 0, anterior: 0 };

function setShare(shares: Map<string, number>, source: string, share: number): void {
  if (share > 0) shares.set(source, Math.min(share, 1));
  else shares.delete(source);
}
