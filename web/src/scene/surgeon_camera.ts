import { Vector3 } from 'three';

import type { PlanFrame } from '../practice/plan_frame';
import { superior, type OrbitCamera } from './orbit_camera';
import { arrived, type EyePose, gone, surgeonsEye } from './surgeon_eye';

/** After this time it has gone two thirds of its way. */
const glideS = 0.22;
const nearEnoughMm = 0.1;

/** From where the picture was seen. */
interface Place {
  pose: EyePose;
  distanceMm: number;
}

/** Moves the camera to where the surgeon stands and keeps it on the reamer, and lets it be upright again afterwards; after theatre it goes back. */
export class SurgeonCamera {
  private following = false;
  private viewRadiusMm: number | undefined;
  private settled = true;
  private plan: PlanFrame | null = null;
  private tool: Vector3 | null = null;
  private up = superior.clone();
  /** Before theatre, in theatre; and after it, until that place is reached or another one is taken. */
  private before: Place | null = null;
  private readonly still = window.matchMedia('(prefers-reduced-motion: reduce)');

  constructor(private readonly orbit: Pick<OrbitCamera, 'eyePose' | 'distanceMm' | 'setEyePose' | 'fittingDistance'>) {}

  setPlan(plan: PlanFrame): void {
    this.plan = plan;
    this.settled = false;
  }
  setTool(tip: Vector3 | null): void {
    this.tool = tip;
    if (this.following) this.settled = false;
  }
  /** `viewRadiusMm`: half of what is seen around the reamer, in theatre; undefined: as in the set views. */
  follow(following: boolean, viewRadiusMm?: number): void {
    if (following === this.following && viewRadiusMm === this.viewRadiusMm) return;
    const inTheatre = following && viewRadiusMm !== undefined;
    // Who has the surgeon's eye in any case has it afterwards, too.
    if (inTheatre && !this.following) this.before = this.place();
    else if (!inTheatre && following) this.before = null;
    this.following = following;
    this.viewRadiusMm = viewRadiusMm;
    this.settled = false;
  }

  /** Somebody has chosen from where the picture is seen. */
  taken(): void {
    if (!this.following) this.before = null;
  }
  /** Another bone is framed: what was seen before is no place on it. */
  framed(): void {
    this.before = this.following && this.before !== null ? this.place() : null;
  }

  private place(): Place {
    return { pose: this.orbit.eyePose(superior.clone()), distanceMm: this.orbit.distanceMm };
  }

  /** Where it goes to. */
  private goal(plan: PlanFrame, now: EyePose): Place {
    const { orbit } = this;
    if (this.following)
      return { pose: surgeonsEye(plan, this.tool), distanceMm: orbit.fittingDistance(this.viewRadiusMm) };
    return this.before ?? { pose: { ...now, up: superior }, distanceMm: orbit.distanceMm };
  }

  /** Goes on for so long; whether there is more way to go. */
  step(seconds: number): boolean {
    const { plan, orbit } = this;
    if (plan === null) return false;
    const share = this.still.matches ? 1 : 1 - Math.exp(-seconds / glideS);
    const now = orbit.eyePose(this.up);
    const { pose: goal, distanceMm: goalMm } = this.goal(plan, now);
    const reached = arrived(now, goal) && Math.abs(goalMm - orbit.distanceMm) < nearEnoughMm;
    const next = reached ? goal : gone(now, goal, share);
    this.up = next.up;
    const distanceMm = orbit.distanceMm + (goalMm - orbit.distanceMm) * (reached ? 1 : share);
    if (this.following || !reached || !this.settled) orbit.setEyePose(next, distanceMm);
    this.settled = reached;
    if (reached) this.taken();
    return !reached;
  }
}
