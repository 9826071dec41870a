import type { Case } from '../../wire/rest_types';
import { neededNames, type PlacedLandmarks, pointOf } from './landmark_names';

export const stepNames = ['segment', 'landmarks', 'plan', 'build', 'ream'] as const;
export type StepName = (typeof stepNames)[number];
/** blocked: another step comes first. */
export type StepState = 'done' | 'todo' | 'outdated' | 'blocked';

export interface StepFacts {
  details: Pick<Case, 'ct' | 'segmentation' | 'plan' | 'built' | 'stage'>;
  landmarks: PlacedLandmarks;
  /** Landmarks were changed after the plan was kept. */
  planBeforeLandmarks: boolean;
}

/**
 * No humeral head was found, which the server remarks on, nor did anybody say where the shoulder is: what is called scapula
 * may be any bone. Cases that were not segmented here, such as phantoms, have neither head nor remark.
 */
export function lacksShoulder(segmentation: Case['segmentation']): boolean {
  if (segmentation === null || segmentation.humeral_head !== null) return false;
  if (segmentation.warnings.length === 0) return false;
  const { humerus, scapula } = segmentation.settings.seeds ?? {};
  return humerus === undefined && scapula === undefined;
}

/** How far each step of the work on a case is. */
export function stepStates({ details, landmarks, planBeforeLandmarks }: StepFacts): Record<StepName, StepState> {
  const { ct, segmentation, plan, built } = details;
  const placed = neededNames.every((name) => pointOf(landmarks, name) !== null);
  const builtIsOld = built !== null && segmentation !== null && built.segmentation_revision !== segmentation.revision;
  const isBuilt = built !== null || details.stage === 'built';
  return {
    segment:
      (segmentation !== null && !lacksShoulder(segmentation)) || (ct === null && isBuilt)
        ? 'done'
        : ct === null
          ? 'blocked'
          : 'todo',
    landmarks: placed ? 'done' : 'todo',
    plan: plan !== null ? (planBeforeLandmarks ? 'outdated' : 'done') : placed ? 'todo' : 'blocked',
    build: isBuilt ? (builtIsOld ? 'outdated' : 'done') : segmentation === null ? 'blocked' : 'todo',
    ream: isBuilt && plan !== null ? 'todo' : 'blocked',
  };
}

/** The step to go on with: what is out of date, the reamer where all it needs is there, else what is to do first. */
export function nextStep(states: Record<StepName, StepState>): StepName {
  const outdated = stepNames.find((name) => states[name] === 'outdated');
  if (outdated !== undefined) return outdated;
  if (states.ream === 'todo') return 'ream';
  return stepNames.find((name) => states[name] === 'todo') ?? 'ream';
}
