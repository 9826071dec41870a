import { batch, effect, signal } from '@preact/signals';

import type { CaseCt } from '../wire/rest_types';
import { requestJson } from '../wire/rest';
import type { Store } from './store';
import type { ScapulaPoints } from './tool_angles';

/** What the page knows of the case that is reamed beside its stream. */
export class LiveCase {
  /** Null where there are none, or where they are not for this person. */
  readonly landmarks = signal<ScapulaPoints | null>(null);
  readonly ct = signal<CaseCt | null>(null);
  /** Whether there is an answer: nothing more is on its way. */
  readonly known = signal(false);

  /** Reads each case that is shown, while the person may read cases. */
  constructor(store: Store, mayRead: () => boolean, origin: string) {
    effect(() => {
      const id = store.hello.value?.caseId ?? '';
      const wanted = id !== '' && mayRead();
      this.take(null, !wanted);
      if (!wanted) return;
      const address = `${origin}/api/v1/cases/${encodeURIComponent(id)}`;
      // Without it angles are said against the plan, and no slices are shown.
      void requestJson<CaseAnswer>(address, 'GET', {}).then(
        (answer) => this.takeOf(id, store, answer),
        () => this.takeOf(id, store, null),
      );
    });
  }

  private takeOf(id: string, store: Store, answer: CaseAnswer | null): void {
    if (id === store.hello.peek()?.caseId) this.take(answer, true);
  }

  private take(answer: CaseAnswer | null, known: boolean): void {
    batch(() => {
      this.landmarks.value = answer?.landmarks ?? null;
      this.ct.value = answer?.ct ?? null;
      this.known.value = known;
    });
  }
}

interface CaseAnswer {
  landmarks: ScapulaPoints | null;
  ct: CaseCt | null;
}
