import { effect } from '@preact/signals';

import { MeshLoader } from '../wire/mesh_loader';
import type { Surface } from '../wire/ply';
import type { Store } from './store';

/** Where the surroundings are seen. */
export interface SurroundingsPicture {
  showSurroundings(surface: Surface | null): void;
}

/**
 * Fetches what lies around the bone of every case that is shown, while the person may read cases and the picture wants it.
 * Without an answer the picture shows the bone alone, as it does where there is nothing around it.
 */
export class Surroundings {
  private readonly loader = new MeshLoader();
  private readonly stop: () => void;

  constructor(store: Store, picture: SurroundingsPicture, wanted: () => boolean, origin: string) {
    let shown = '';
    this.stop = effect(() => {
      const hello = store.hello.value;
      const id = wanted() ? (hello?.caseId ?? '') : '';
      if (id === shown) return;
      shown = id;
      picture.showSurroundings(null);
      if (id === '') return;
      const take = (surface: Surface | null) => {
        if (surface !== null && shown === id) picture.showSurroundings(surface);
      };
      void this.loader
        .load(`${origin}/api/v1/cases/${encodeURIComponent(id)}/surroundings`)
        .then(take, () => undefined);
    });
  }

  dispose(): void {
    this.stop();
    this.loader.dispose();
  }
}
