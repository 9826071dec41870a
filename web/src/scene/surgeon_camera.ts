import { Vector3 } from 'three';

import type { PlanFrame } from '../practice/plan_frame';
import { superior, type OrbitCamera } from './orbit_camera';
import { arrived, gone, surgeonsEye } from './surgeon_eye';

/** After this time it has gone two thirds of its way. */
const glideS = 0.22;
const nearEnoughMm = 0.1;

/** Moves the camera to where the surgeon stands and keeps it on the reamer, and lets it be upright again afterwards. */
export class SurgeonCamera {
  private following = false;
  private viewRadiusMm: number | undefined;
  private settled = true;
  private plan: PlanFrame | null = null;
  private tool: Vector3 | null = null;
  private up = superior.clone();
  private readonly still = window.matchMedia('(prefers-reduced-motion: reduce)');

  constructor(private readonly orbit: OrbitCamera) {}

  setPlan(plan: PlanFrame): void {
    this.plan = plan;
    this.settled = false;
  }
  setTool(tip: Vector3 | null): void {
    this.tool = tip;
    if (this.following) this.settled = false;
  }
  /** `viewRadiusMm`: half of what is seen around the reamer; undefined: as in the set views. */
  follow(following: boolean, viewRadiusMm?: number): void {
    if (following === this.following && viewRadiusMm === this.viewRadiusMm) return;
    this.following = following;
    this.viewRadiusMm = viewRadiusMm;
    this.settled = false;
  }

  /** Goes on for so long; whether there is more way to go. */
  step(seconds: number): boolean {
    const { plan, orbit } = this;
    if (plan === null) return false;
    const share = this.still.matches ? 1 : 1 - Math.exp(-seconds / glideS);
    const now = orbit.eyePose(this.up);
    const goal = this.following ? surgeonsEye(plan, this.tool) : { ...now, up: superior };
    const goalMm = this.following ? orbit.fittingDistance(this.viewRadiusMm) : orbit.distanceMm;
    const reached = arrived(now, goal) && Math.abs(goalMm - orbit.distanceMm) < nearEnoughMm;
    const next = reached ? goal : gone(now, goal, share);
    this.up = next.up;
    const distanceMm = orbit.distanceMm + (goalMm - orbit.distanceMm) * (reached ? 1 : share);
    if (this.following || !reached || !this.settled) orbit.setEyePose(next, distanceMm);
    this.settled = reached;
    return !reached;
  }
}
