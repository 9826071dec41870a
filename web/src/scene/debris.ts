import { Quaternion, Vector3 } from 'three';

import type { ToolAction } from '../state/tool_action';
import { faceHeightMm, type ToolProfile } from './tool_profile';

export const chipsMost = 150;
export const dropsMost = 50;
/** Chips are seen to be more or less, not counted. */
const chipsPerMm3 = 1.6;
const chipsAtOnceMost = 8;
/** Between two messages that are further apart something else happened than reaming: a jump, or a loss. */
const apartMostTicks = 400;
const chipLifeS = { least: 0.6, most: 1.1 };
const washedFaster = 2.5;
const dropsPerS = 90;
const dropLifeS = { least: 0.22, most: 0.4 };
/** What flies is soon held by what is wet; then it sinks. */
const dragPerS = 4;
const fallMmS2 = 160;
const washMmS2 = 500;
const seed = 0x5eed1e55;

export interface Particle {
  kind: 'chip' | 'drop';
  at: Vector3;
  velocity: Vector3;
  turn: Quaternion;
  sizeMm: number;
  /** 0 to 1, of what is different from one to the next. */
  shade: number;
  ageS: number;
  lifeS: number;
}

/** Where the reamer is, and its shape. */
export interface Source {
  at: Vector3;
  turn: Quaternion;
  profile: ToolProfile;
}

/**
 * Chips of wet bone that the reamer throws out, as many as it removes bone, and the water that washes them away. World
 * frame, mm. The same calls give the same.
 */
export class Debris {
  readonly particles: Particle[] = [];
  private random = randomNumbers(seed);
  private before: ToolAction | null = null;
  private chipsDue = 0;
  private dropsDue = 0;

  /** What the reamer has done by now; null: all of it is gone at once. */
  follow(action: ToolAction | null, source: Source | null): void {
    const { before } = this;
    this.before = action;
    if (action === null || source === null) return this.clear();
    if (before === null || action.tick <= before.tick || action.tick - before.tick > apartMostTicks) return;
    const removedMm3 = Math.max(action.removedMm3 - before.removedMm3, 0);
    this.chipsDue = Math.min(this.chipsDue + removedMm3 * chipsPerMm3, chipsAtOnceMost);
    for (; this.chipsDue >= 1; --this.chipsDue)
      if (this.count('chip') < chipsMost) this.particles.push(this.chip(source, Math.sign(action.spindleRadS)));
  }

  /** Goes on for so long; whether anything is seen of it, or will be at once. */
  step(seconds: number, source: Source | null): boolean {
    const wet = this.before?.irrigating === true;
    for (const particle of this.particles) move(particle, seconds, wet);
    const alive = this.particles.filter(({ ageS, lifeS }) => ageS < lifeS);
    this.particles.splice(0, Infinity, ...alive);
    if (wet && source !== null) this.pour(seconds, source);
    return wet || this.particles.length > 0;
  }

  private clear(): void {
    this.particles.length = 0;
    this.chipsDue = 0;
    this.dropsDue = 0;
    this.random = randomNumbers(seed);
  }

  private count(kind: Particle['kind']): number {
    return this.particles.filter((particle) => particle.kind === kind).length;
  }

  private between(least: number, most: number): number {
    return least + (most - least) * this.random();
  }

  /** From the rim, and through the openings towards the back; along with the turn and out. */
  private chip({ at, turn, profile }: Source, direction: number): Particle {
    const offMm = profile.rimMm * Math.sqrt(this.between(0.3, 1.02));
    const angle = this.between(0, 2 * Math.PI);
    const [out, along] = [
      new Vector3(Math.cos(angle), Math.sin(angle), 0),
      new Vector3(-Math.sin(angle), Math.cos(angle), 0),
    ];
    const velocity = out.clone().multiplyScalar(this.between(10, 55));
    velocity.addScaledVector(along, direction * this.between(10, 50)).add(new Vector3(0, 0, this.between(-60, -15)));
    const place = out.multiplyScalar(offMm).setZ(faceHeightMm(profile, offMm) - this.between(0.5, 3));
    return {
      kind: 'chip',
      at: place.applyQuaternion(turn).add(at),
      velocity: velocity.applyQuaternion(turn),
      turn: new Quaternion(this.between(-1, 1), this.between(-1, 1), this.between(-1, 1), 1).normalize(),
      sizeMm: this.between(0.35, 0.85),
      shade: this.random(),
      ageS: 0,
      lifeS: this.between(chipLifeS.least, chipLifeS.most),
    };
  }

  /** From a nozzle above and behind the rim, onto the rim. */
  private pour(seconds: number, source: Source): void {
    this.dropsDue = Math.min(this.dropsDue + dropsPerS * seconds, dropsMost);
    for (; this.dropsDue >= 1; --this.dropsDue)
      if (this.count('drop') < dropsMost) this.particles.push(this.drop(source));
  }

  private drop({ at, turn, profile }: Source): Particle {
    const back = new Vector3(0, 0, -1).applyQuaternion(turn);
    // Superior is up at the beach chair.
    const up = new Vector3(0, 0, 1).addScaledVector(back, -back.z);
    if (up.lengthSq() < 0.01) up.set(1, 0, 0).applyQuaternion(turn);
    up.normalize();
    const goal = at.clone().addScaledVector(up, profile.rimMm * this.between(0.6, 1.1));
    goal.addScaledVector(back, -profile.backZMm).addScaledVector(up.clone().cross(back), this.between(-4, 4));
    const from = at.clone().addScaledVector(up, profile.rimMm + 16);
    from.addScaledVector(back, 22).addScaledVector(up.clone().cross(back), this.between(-0.8, 0.8));
    const lifeS = this.between(dropLifeS.least, dropLifeS.most);
    return {
      kind: 'drop',
      velocity: goal.sub(from).divideScalar(dropLifeS.least),
      at: from,
      turn: new Quaternion(),
      sizeMm: this.between(0.22, 0.42),
      shade: this.random(),
      ageS: 0,
      lifeS,
    };
  }
}

function move(particle: Particle, seconds: number, wet: boolean): void {
  const { kind, at, velocity } = particle;
  const isChip = kind === 'chip';
  particle.ageS += seconds * (isChip && wet ? washedFaster : 1);
  at.addScaledVector(velocity, seconds);
  if (isChip) velocity.multiplyScalar(Math.exp(-dragPerS * seconds));
  // A drop bounces off where it has met the bone.
  else if (particle.ageS > dropLifeS.least && particle.ageS - seconds <= dropLifeS.least)
    velocity.multiplyScalar(-0.25);
  velocity.z -= (isChip && wet ? washMmS2 : fallMmS2) * seconds;
}

/** 0 to below 1 (mulberry32). */
function randomNumbers(from: number): () => number {
  let state = from;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}
