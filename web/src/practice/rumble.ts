const effectMs = 100;
const refreshMs = 80;
/** Weight of the newest sample in the mean square; samples come some thirty times a second. */
const newestShare = 0.25;
/** No motor turns for less. */
const leastMagnitude = 0.02;
/** Weak motor at the two published accelerations of reaming, cancellous and cortical bone, g rms. */
const gentle = { g: 0.3, magnitude: 0.75 };
const strong = { g: 0.4, magnitude: 1 };

/** Share of the weak motor for an acceleration in g rms. */
export function weakMagnitude(vibrationG: number): number {
  if (!(vibrationG > 0)) return 0;
  if (vibrationG <= gentle.g) return (vibrationG / gentle.g) * gentle.magnitude;
  const slope = (strong.magnitude - gentle.magnitude) / (strong.g - gentle.g);
  return Math.min(gentle.magnitude + (vibrationG - gentle.g) * slope, 1);
}

export interface RumbleMotor {
  playEffect(type: 'dual-rumble', effect: { duration: number; weakMagnitude: number }): Promise<unknown>;
}

/** Lets a gamepad tremble as the reamer does; effects are short, so that it stops by itself when nobody asks for more. */
export class Rumble {
  private nextMs = 0;
  private meanSquareG2 = 0;

  /** Takes one sample of the tool's acceleration. */
  feel(vibrationG: number): void {
    if (Number.isFinite(vibrationG)) this.meanSquareG2 += newestShare * (vibrationG ** 2 - this.meanSquareG2);
  }

  /** What was felt belongs to a hand that is no longer there. */
  forget(): void {
    this.meanSquareG2 = 0;
  }

  play(motor: RumbleMotor | null | undefined, nowMs: number): void {
    const magnitude = weakMagnitude(Math.sqrt(this.meanSquareG2));
    if (!motor || magnitude < leastMagnitude || nowMs < this.nextMs) return;
    this.nextMs = nowMs + refreshMs;
    // A pad that was unplugged a moment ago refuses; the next step sees that it is gone.
    motor.playEffect('dual-rumble', { duration: effectMs, weakMagnitude: magnitude }).catch(() => undefined);
  }
}
