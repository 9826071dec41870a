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

  it('keeps the bones to do where no shoulder was found, unless somebody says where it is', () => {
    const found = (settings: object, head: object | null = null, warnings = ['no head']) =>
      ({ revision: 1, humeral_head: head, settings, warnings }) as NonNullable<Case['segmentation']>;
    const stateOf = (segmentation: Case['segmentation']) => stepStates(facts({ segmentation })).segment;
    expect(stateOf(found({}))).toBe('todo');
    expect(stateOf(found({ seeds: {} }))).toBe('todo');
    expect(stateOf(found({ seeds: { clavicle: [1, 2, 3] } }))).toBe('todo');
    expect(stateOf(found({ seeds: { scapula: [1, 2, 3] } }))).toBe('done');
    expect(stateOf(found({}, { centre_mm: [1, 2, 3], radius_mm: 24 }))).toBe('done');
    expect(stateOf(found({}, null, []))).toBe('done');
    expect(nextStep(stepStates(facts({ segmentation: found({}) }, { landmarks: allPlaced })))).toBe('segment');
  });

  it('knows cases that were built without their CT', () => {
    const states = stepStates(facts({ ct: null, plan, stage: 'built' }));
    expect(states).toMatchObject({ segment: 'done', build: 'done', ream: 'todo' });
    expect(nextStep(states)).toBe('ream');
  });
});
