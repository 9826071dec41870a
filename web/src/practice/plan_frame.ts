import { Vector3 } from 'three';

import type { Hello } from '../wire/messages';

/** LPS: superior is z, anterior -y. */
const worldSuperior = new Vector3(0, 0, 1);
const worldAnterior = new Vector3(0, -1, 0);

/** How far the hand may go from the plan. */
export const sidewaysMaxMm = 20;
export const leanMaxDeg = 20;

/** A place or a lean beside the plan, along the two directions square to the planned axis; mm or degrees. */
export interface Beside {
  superior: number;
  anterior: number;
}

/** A line of sight, world frame. */
export interface Ray {
  origin: Vector3;
  /** Unit. */
  direction: Vector3;
}

/** The plan as the hand sees it, world frame: the entry, the axis into the bone, and the directions square to it. */
export class PlanFrame {
  readonly entry: Vector3;
  readonly axis: Vector3;
  readonly superior: Vector3;
  readonly anterior: Vector3;

  constructor(plan: Pick<Hello, 'axisEntryMm' | 'axisDirection'>) {
    this.entry = new Vector3(...plan.axisEntryMm);
    this.axis = new Vector3(...plan.axisDirection).normalize();
    this.superior = square(worldSuperior, this.axis) ?? square(worldAnterior, this.axis) ?? new Vector3(1, 0, 0);
    this.anterior = new Vector3().crossVectors(this.axis, this.superior);
    if (this.anterior.dot(worldAnterior) < 0) this.anterior.negate();
  }

  /** The part of a world vector that is square to the axis. */
  beside(v: Vector3): Beside {
    return { superior: v.dot(this.superior), anterior: v.dot(this.anterior) };
  }

  /** World vector of a place beside the entry. */
  sideways(place: Beside): Vector3 {
    return new Vector3().addScaledVector(this.superior, place.superior).addScaledVector(this.anterior, place.anterior);
  }

  /** Where the tool's axis points when its handle leans by so many degrees; unit, world frame. */
  leant(lean: Beside): Vector3 {
    const tangent = (degrees: number) => Math.tan((degrees * Math.PI) / 180);
    return this.axis
      .clone()
      .addScaledVector(this.superior, -tangent(lean.superior))
      .addScaledVector(this.anterior, -tangent(lean.anterior))
      .normalize();
  }

  /**
   * The place beside the entry that a line of sight meets. One that runs nearly within the plane cannot say how far
   * away it means; then `now` is kept along it and only what is across the sight changes.
   */
  placeUnder(ray: Ray, now: Beside): Beside {
    const steepness = ray.direction.dot(this.axis);
    if (Math.abs(steepness) > grazing) {
      const toEntry = this.entry.clone().sub(ray.origin);
      const along = toEntry.dot(this.axis) / steepness;
      if (along <= 0) return now;
      return limited(this.beside(ray.direction.clone().multiplyScalar(along).sub(toEntry)), sidewaysMaxMm);
    }
    const present = this.entry.clone().add(this.sideways(now));
    const toPresent = present.sub(ray.origin);
    const nearest = ray.direction.clone().multiplyScalar(toPresent.dot(ray.direction));
    const moved = this.beside(nearest.sub(toPresent));
    return limited({ superior: now.superior + moved.superior, anterior: now.anterior + moved.anterior }, sidewaysMaxMm);
  }
}

/** Cosine below which a line of sight is taken to run within the plane. */
const grazing = 0.25;

/** Shortened to `most` where it is longer. */
export function limited(beside: Beside, most: number): Beside {
  const length = Math.hypot(beside.superior, beside.anterior);
  if (length <= most) return beside;
  return { superior: (beside.superior * most) / length, anterior: (beside.anterior * most) / length };
}

function square(v: Vector3, axis: Vector3): Vector3 | null {
  const part = v.clone().addScaledVector(axis, -v.dot(axis));
  return part.length() < 0.05 ? null : part.normalize();
}
