import { effect, signal } from '@preact/signals';

import { requestJson } from '../wire/rest';
import type { Store } from './store';
import type { ScapulaPoints } from './tool_angles';

/** What the page knows of the case that is reamed beside its stream. */
export class LiveCase {
  /** Null where there are none, or where they are not for this person. */
  readonly landmarks = signal<ScapulaPoints | null>(null);

  /** Reads the landmarks of each case that is shown, while the person may read cases. */
  constructor(store: Store, mayRead: () => boolean, origin: string) {
    effect(() => {
      const id = store.hello.value?.caseId ?? '';
      const wanted = id !== '' && mayRead();
      this.landmarks.value = null;
      if (!wanted) return;
      const address = `${origin}/api/v1/cases/${encodeURIComponent(id)}`;
      // Without them the angles are said against the plan.
      void requestJson<{ landmarks: ScapulaPoints | null }>(address, 'GET', {}).then(
        ({ landmarks }) => {
          if (id === store.hello.peek()?.caseId) this.landmarks.value = landmarks;
        },
        () => undefined,
      );
    });
  }
}
