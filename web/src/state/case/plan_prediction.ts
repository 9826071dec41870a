import type { Signal } from '@preact/signals';

import type { CaseApi } from '../../wire/case_api';
import type { NewPlan, Plan } from '../../wire/rest_types';
import { messageOf } from '../../wire/rest';
import type { PlanDraft } from './case_store';
import { pause } from './job_watch';

/** A number that is typed or stepped through is not yet the one that is meant. */
const restsMs = 250;

/** A plan as it is sent: without a pilot hole where there is none. */
export function newPlanOf({ pilot_diameter_mm: diameter, pilot_depth_mm: depth, ...plan }: Plan): NewPlan {
  const pilot = diameter === null || depth === null ? {} : { pilot_diameter_mm: diameter, pilot_depth_mm: depth };
  return { ...plan, ...pilot };
}

/** Keeps what the draft would do, and what it would reach, in step with the draft. Asks one question at a time. */
export class PlanPrediction {
  private asked = 0;
  private running = false;

  constructor(
    private readonly api: Pick<CaseApi, 'assessPlan'>,
    private readonly caseId: string,
    private readonly draft: Signal<PlanDraft | null>,
    /** Why it is not known. */
    private readonly problem: Signal<string | null>,
  ) {}

  /** The draft, or what it is planned on, is another: what is known is of before. */
  async update(signal: AbortSignal): Promise<void> {
    ++this.asked;
    this.problem.value = null;
    if (this.running) return;
    this.running = true;
    for (let answered = 0; answered !== this.asked && !signal.aborted;) {
      answered = this.asked;
      await pause(restsMs);
      if (answered === this.asked && !signal.aborted) await this.ask(answered, signal);
    }
    this.running = false;
  }

  /** An answer about a draft before the present one is thrown away. */
  private async ask(asked: number, signal: AbortSignal): Promise<void> {
    const plan = this.draft.value?.plan;
    if (plan === undefined) return;
    const isOld = () => asked !== this.asked || signal.aborted;
    try {
      const { assessment, outcome } = await this.api.assessPlan(this.caseId, newPlanOf(plan));
      const draft = this.draft.value;
      if (!isOld() && draft !== null) this.draft.value = { ...draft, assessment, outcome, isAssessed: true };
    } catch (error) {
      if (!isOld()) this.problem.value = messageOf(error);
    }
  }
}
