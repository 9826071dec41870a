import { describe, expect, it } from 'vitest';

import { nextStep, type StepFacts, stepStates } from '../../../src/state/case/case_steps';
import { neededNames, type PlacedLandmarks, withPoint } from '../../../src/state/case/landmark_names';
import type { Case } from '../../../src/wire/rest_types';

const ct = {} as Case['ct'];
const segmentation = (revision: number) => ({ revision }) as Case['segmentation'];
const built = (of: number) => ({ segmentation_revision: of }) as Case['built'];
const plan = {} as Case['plan'];
const allPlaced = neededNames.reduce<PlacedLandmarks>((placed, name) => withPoint(placed, name, [1, 2, 3]), {});

function facts(details: Partial<StepFacts['details']>, others: Partial<StepFacts> = {}): StepFacts {
  const none = { ct, segmentation: null, plan: null, built: null, stage: 'ct' as const };
  return { details: { ...none, ...details }, landmarks: {}, planBeforeLandmarks: false, ...others };
}

describe('stepStates', () => {
  it('leads from a fresh CT to the reamer one step after the other', () => {
    let states = stepStates(facts({}));
    expect(states).toEqual({ segment: 'todo', landmarks: 'todo', plan: 'blocked', build: 'blocked', ream: 'blocked' });
    expect(nextStep(states)).toBe('segment');
    const found = { segmentation: segmentation(1), stage: 'segmented' as const };
    expect(nextStep(stepStates(facts(found)))).toBe('landmarks');
    states = stepStates(facts(found, { landmarks: allPlaced }));
    expect(nextStep(states)).toBe('plan');
    states = stepStates(facts({ ...found, plan }, { landmarks: allPlaced }));
    expect(nextStep(states)).toBe('build');
    const all = { segmentation: segmentation(1), plan, built: built(1), stage: 'built' as const };
    states = stepStates(facts(all, { landmarks: allPlaced }));
    expect(states.ream).toBe('todo');
    expect(nextStep(states)).toBe('ream');
  });

  it('says what is out of date, and goes there first', () => {
    const all = { segmentation: segmentation(2), plan, built: built(1), stage: 'built' as const };
    const states = stepStates(facts(all, { landmarks: allPlaced, planBeforeLandmarks: true }));
    expect(states.build).toBe('outdated');
    expect(states.plan).toBe('outdated');
    expect(nextStep(states)).toBe('plan');
  });

  it('knows cases that were built without their CT', () => {
    const states = stepStates(facts({ ct: null, plan, stage: 'built' }));
    expect(states).toMatchObject({ segment: 'done', build: 'done', ream: 'todo' });
    expect(nextStep(states)).toBe('ream');
  });
});
