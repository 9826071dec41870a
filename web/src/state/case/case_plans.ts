import { signal } from '@preact/signals';

import type { CaseApi } from '../../wire/case_api';
import type { CaseSummary, Plan } from '../../wire/rest_types';

/** Plans of the cases in the list, read one after the other: the list itself says only whether there is one. */
export class CasePlans {
  readonly plans = signal<Readonly<Record<string, Plan>>>({});
  private reading = false;

  constructor(private readonly api: Pick<CaseApi, 'case'>) {}

  /** Reads those that are not known yet; a case that cannot be read is left out. */
  async read(cases: readonly CaseSummary[]): Promise<void> {
    if (this.reading) return;
    this.reading = true;
    for (const { id, planned } of cases) {
      if (!planned || this.plans.value[id] !== undefined) continue;
      const plan = await this.api.case(id).then(
        (details) => details.plan,
        () => null,
      );
      if (plan !== null) this.plans.value = { ...this.plans.value, [id]: plan };
    }
    this.reading = false;
  }

  /** They may have been changed on another page. */
  forget(): void {
    this.plans.value = {};
  }
}
