// The page's case controllers against the fake server, over HTTP.
import { afterAll, beforeAll, describe, expect, it, vi } from 'vitest';

import { truth } from '../../../../tests/support/fake_case/ct';
import { serve } from '../../../../tests/support/fake_stream/server';
import { CaseController } from '../../../src/state/case/case_controller';
import { landmarkNames, neededNames } from '../../../src/state/case/landmark_names';
import { CaseListController } from '../../../src/state/case/new_case';
import { CaseApi } from '../../../src/wire/case_api';

let api: CaseApi;
let memory: Map<string, string>;
let ready: string[];
let cases: CaseListController;

const file = (name: string, bytes: number) => ({
  name,
  size: bytes,
  lastModified: 1,
  slice: (from: number, to: number) => ({ arrayBuffer: () => Promise.resolve(new ArrayBuffer(to - from)) }),
});
const until = (condition: () => boolean) => vi.waitFor(() => expect(condition()).toBe(true), { timeout: 8000 });

beforeAll(async () => {
  api = new CaseApi(await serve(0, '.'));
  memory = new Map();
  ready = [];
  const remembered = {
    getItem: (key: string) => memory.get(key) ?? null,
    setItem: (key: string, value: string) => void memory.set(key, value),
    removeItem: (key: string) => void memory.delete(key),
  };
  cases = new CaseListController(api, remembered, (id) => ready.push(id));
});
afterAll(() => cases.cancel());

async function newCase(): Promise<CaseController> {
  cases.choose(file('shoulder.zip', 2_500_000));
  cases.side.value = 'right';
  await cases.make();
  const controller = new CaseController(api, ready.at(-1) ?? '');
  await controller.open();
  return controller;
}

describe('CaseListController', () => {
  it('makes nothing before it knows which shoulder it is', async () => {
    cases.choose(file('shoulder.zip', 100));
    await cases.make();
    expect(cases.state.value.kind).toBe('idle');
    expect(ready).toEqual([]);
  });

  it('makes a case of a file and lists it', async () => {
    const controller = await newCase();
    expect(cases.cases.value?.map(({ id }) => id)).toContain(controller.caseId);
    expect(cases.file.value).toBeNull();
    expect(cases.side.value).toBeNull();
    expect(memory.size).toBe(0);
    controller.leave();
  });

  it('says why a file became no case', async () => {
    cases.choose(file('broken.zip', 100));
    cases.side.value = 'left';
    await cases.make();
    expect(cases.state.value).toMatchObject({ kind: 'failed', during: 'import' });
    expect(cases.state.value).toHaveProperty('message', expect.stringContaining('no image could be read'));
  });

  it('ends an import that is not wanted', async () => {
    cases.choose(file('shoulder.zip', 100));
    cases.side.value = 'left';
    const made = ready.length;
    const making = cases.make();
    await until(() => cases.state.value.kind === 'importing');
    await cases.cancel();
    await making;
    expect(cases.state.value.kind).toBe('idle');
    expect(ready.length).toBe(made);
  });
});

describe('CaseController', () => {
  it('leads a case from its CT to a bone that can be reamed', async () => {
    const controller = await newCase();
    const { store } = controller;
    expect(store.openStep.value).toBe('segment');
    expect(store.settings.value?.threshold_hu).toBe(226);
    expect(store.previewFromHu.value).toBe(226);

    await controller.segment({ sigma_mm: 0, separate: true, seeds: {}, fill_holes: true, threshold_hu: 300 });
    expect(store.job.value).toBeNull();
    expect(store.details.value?.segmentation?.parts[0]?.name).toBe('scapula');
    expect(store.framed.value.box).not.toBeNull();

    controller.choose('glenoid_centre_mm');
    for (const name of neededNames) {
      expect(store.armed.value).toEqual({ kind: 'landmark', name });
      const point = truth[name];
      if (point !== undefined) controller.placeArmed(point);
    }
    expect(store.armed.value).toEqual({ kind: 'landmark', name: 'humeral_head' });
    await until(() => controller.landmarks.measured.value);
    expect(controller.landmarks.measures.value?.version_3d_deg).toBeCloseTo(-8.1, 6);

    await controller.proposePlan({ version_deg: 12 });
    expect(store.draft.value).toMatchObject({ kept: false, isAssessed: true });
    await controller.keepPlan(null);
    expect(store.overrideRequired.value).toContain('override');
    expect(store.draft.value?.kept).toBe(false);
    await controller.keepPlan('for teaching');
    expect(store.draft.value?.kept).toBe(true);
    expect(store.details.value?.plan).toMatchObject({ override: true, override_reason: 'for teaching' });

    const kept = store.draft.value?.plan;
    if (kept === undefined) throw new Error('no plan');
    controller.draftPlan({ ...kept, depth_mm: 3 });
    expect(store.draft.value).toMatchObject({ kept: false, isAssessed: false });
    expect(store.draft.value?.plan).not.toHaveProperty('override');
    await until(() => store.draft.value?.isAssessed === true);
    expect(store.draft.value).toMatchObject({ kept: false, outcome: { depth_mean_mm: 3 } });
    controller.draftPlan({ ...kept, depth_mm: 1 });
    controller.draftPlan({ ...kept, depth_mm: 4 });
    expect(store.draft.value).toMatchObject({ isAssessed: false, outcome: { depth_mean_mm: 3 } });
    await until(() => store.draft.value?.isAssessed === true);
    expect(store.draft.value).toMatchObject({ outcome: { depth_mean_mm: 4, parts_through_vault: 1 } });

    await controller.build({ upsample: 4, roi: 'glenoid', cartilage_mm: 0 });
    expect(store.details.value?.stage).toBe('built');
    await controller.segment({ sigma_mm: 0, separate: true, seeds: {}, fill_holes: true, threshold_hu: 250 });
    const { built, segmentation } = store.details.value ?? {};
    expect(built?.segmentation_revision).not.toBe(segmentation?.revision);
    await controller.undoSegmentation();
    expect(store.settings.value?.threshold_hu).toBe(300);
    controller.leave();
  });

  it('chooses landmarks by number and shows where they are', async () => {
    const controller = await newCase();
    const { store } = controller;
    controller.chooseByNumber(6);
    expect(store.armed.value).toEqual({ kind: 'landmark', name: landmarkNames[5] });
    expect(controller.placesNew()).toBe(true);
    controller.placeArmed([-57, 10, -8]);
    store.crossHair.value = [1, 1, 1];
    controller.chooseByNumber(6);
    expect(controller.placesNew()).toBe(false);
    store.crossHairMm.value?.forEach((value, i) => expect(value).toBeCloseTo([-57, 10, -8][i] ?? 0, 9));
    controller.leave();
  });

  it('says that a case cannot be opened', async () => {
    const controller = new CaseController(api, 'nowhere');
    await controller.open();
    expect(controller.store.loadProblem.value).toContain("no case 'nowhere'");
  });

  it('only looks at a case where the user may not edit it', async () => {
    const made = await newCase();
    made.leave();
    const controller = new CaseController(api, made.caseId, false);
    await controller.open();
    expect(controller.store.openStep.value).toBe('ream');
    controller.chooseByNumber(1);
    controller.chooseMark({ kind: 'landmark', name: 'glenoid_centre_mm' });
    expect(controller.store.openStep.value).toBe('ream');
    expect(controller.store.armed.value).toBeNull();
    controller.leave();
  });
});
