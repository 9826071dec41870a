import { effect } from '@preact/signals';

import { isTwoPlates } from '../wire/messages';
import type { Surface } from '../wire/ply';
import type { Store } from './store';

/** Fetches a surface; null where a newer one was asked for meanwhile. */
export interface SurfaceSource {
  load(url: string): Promise<Surface | null>;
  dispose(): void;
}

/** Where the surroundings are seen. */
export interface SurroundingsPicture {
  showSurroundings(surface: Surface | null): void;
}

/**
 * Fetches what lies around the bone of every shoulder that is shown, while the person may read cases and the picture wants it.
 * Without an answer the picture shows the bone alone, as it does where there is nothing around it.
 */
export class Surroundings {
  private readonly stop: () => void;

  /** The source is this one's from here on. */
  constructor(
    store: Pick<Store, 'hello'>,
    picture: SurroundingsPicture,
    private readonly source: SurfaceSource,
    wanted: () => boolean,
    origin: string,
  ) {
    let shown = '';
    this.stop = effect(() => {
      const hello = store.hello.value;
      const id = hello !== null && wanted() && !isTwoPlates(hello) ? hello.caseId : '';
      if (id === shown) return;
      shown = id;
      picture.showSurroundings(null);
      if (id === '') return;
      const take = (surface: Surface | null) => {
        if (surface !== null && shown === id) picture.showSurroundings(surface);
      };
      const url = `${origin}/api/v1/cases/${encodeURIComponent(id)}/surroundings`;
      // Asked for again with the next connection, as it may be there then.
      const forget = () => {
        if (shown === id) shown = '';
      };
      void this.source.load(url).then(take, forget);
    });
  }

  dispose(): void {
    this.stop();
    this.source.dispose();
  }
}
