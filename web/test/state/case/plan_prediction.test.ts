import { signal } from '@preact/signals';
import { describe, expect, it, vi } from 'vitest';

import type { PlanDraft } from '../../../src/state/case/case_store';
import { PlanPrediction } from '../../../src/state/case/plan_prediction';
import type { NewPlan, Plan, PlanAssessment, PlanOutcome } from '../../../src/wire/rest_types';

const planOf = (depth: number) => ({ depth_mm: depth, pilot_diameter_mm: null, pilot_depth_mm: null }) as Plan;
const draftOf = (depth: number): PlanDraft => ({
  plan: planOf(depth),
  assessment: null,
  outcome: null,
  isAssessed: false,
  kept: false,
});

/** Answers when it is told to, with the depth that it was asked about as the mean depth. */
class SlowServer {
  asked: number[] = [];
  private answers: (() => void)[] = [];
  fails = false;

  assessPlan(_id: string, plan: NewPlan) {
    this.asked.push(plan.depth_mm);
    return new Promise<{ assessment: PlanAssessment; outcome: PlanOutcome }>((resolve, reject) => {
      this.answers.push(() => {
        const outcome = { depth_mean_mm: plan.depth_mm } as PlanOutcome;
        if (this.fails) reject(new Error('not segmented yet'));
        else resolve({ assessment: {} as PlanAssessment, outcome });
      });
    });
  }
  answer(): void {
    this.answers.shift()?.();
  }
}

function setUp() {
  const server = new SlowServer();
  const draft = signal<PlanDraft | null>(draftOf(1));
  const problem = signal<string | null>(null);
  const page = new AbortController();
  const prediction = new PlanPrediction(server, 'shoulder', draft, problem);
  const change = (depth: number) => {
    draft.value = { ...(draft.value ?? draftOf(depth)), plan: planOf(depth), isAssessed: false };
    void prediction.update(page.signal);
  };
  const asked = (times: number) => vi.waitFor(() => expect(server.asked.length).toBe(times), { timeout: 3000 });
  return { server, draft, problem, page, change, asked };
}

describe('the prediction of a plan', () => {
  it('is asked one at a time, and an answer about an older draft is thrown away', async () => {
    const { server, draft, change, asked } = setUp();
    change(1);
    await asked(1);
    change(2);
    change(3);
    await new Promise((done) => setTimeout(done, 400));
    expect(server.asked).toEqual([1]);
    server.answer();
    await asked(2);
    expect(draft.value).toMatchObject({ isAssessed: false, outcome: null });
    server.answer();
    await vi.waitFor(() => expect(draft.value).toMatchObject({ isAssessed: true, outcome: { depth_mean_mm: 3 } }));
    expect(server.asked).toEqual([1, 3]);
  });

  it('says why there is none until the draft is another', async () => {
    const { server, draft, problem, change, asked } = setUp();
    server.fails = true;
    change(1);
    await asked(1);
    server.answer();
    await vi.waitFor(() => expect(problem.value).toBe('not segmented yet'));
    server.fails = false;
    change(2);
    expect(problem.value).toBeNull();
    await asked(2);
    server.answer();
    await vi.waitFor(() => expect(draft.value?.isAssessed).toBe(true));
  });

  it('changes nothing on a page that was left', async () => {
    const { server, draft, page, change, asked } = setUp();
    change(1);
    await asked(1);
    page.abort();
    server.answer();
    await new Promise((done) => setTimeout(done, 50));
    expect(draft.value?.isAssessed).toBe(false);
  });
});
