import { signal } from '@preact/signals';

import { SharedCamera } from '../../scene/shared_camera';
import { ReviewView } from '../../scene/review_view';
import { LiveCase } from '../../state/live_case';
import { Surroundings } from '../../state/surroundings';
import type { Permissions } from '../../state/permissions';
import { ReviewSession } from '../../state/review/review_session';
import { ReviewSettings } from '../../state/review/review_settings';
import { Api } from '../../wire/api';
import { ReviewApi } from '../../wire/review_api';
import { WorkerStreamSocket } from '../../wire/stream_socket';
import { MeshLoader } from '../../wire/mesh_loader';
import { loadSurface } from '../../wire/surface_loader';

/** One session that is reviewed, with its picture. */
export interface Pane {
  session: ReviewSession;
  view: ReviewView;
  liveCase: LiveCase;
  close(): void;
}

/** The sessions that are reviewed beside each other, as long as their page is open. */
export class ReviewWorkspace {
  readonly settings = new ReviewSettings();
  readonly panes = signal<readonly Pane[]>([]);
  readonly review: ReviewApi;
  private readonly camera = new SharedCamera();

  constructor(
    private readonly origin: string,
    private readonly may: Permissions,
  ) {
    this.review = new ReviewApi(origin);
  }

  /** What stays in its place stays as it is. */
  show(ids: readonly string[]): void {
    const before = this.panes.peek();
    // The one that is left when the other is closed moves with all that was done to it.
    const left = [...before];
    const panes = ids.map((id) => {
      const found = left.findIndex(({ session }) => session.id === id);
      return (found < 0 ? undefined : left.splice(found, 1)[0]) ?? this.open(id);
    });
    for (const pane of left) pane.close();
    this.panes.value = panes;
    this.settings.active.value = Math.min(this.settings.active.peek(), Math.max(ids.length - 1, 0));
  }

  dispose(): void {
    this.show([]);
  }

  private open(id: string): Pane {
    const view = new ReviewView(this.settings, this.camera);
    const { review } = this;
    // What is measured here is measured on all that there is.
    const socket = new WorkerStreamSocket(false);
    const sources = {
      api: new Api(this.origin),
      review,
      socket,
      surface: (of: string, onProgress: (share: number) => void, abort: AbortSignal) =>
        loadSurface({ url: review.meshUrl(of), jobs: review.jobsUrl() }, onProgress, abort),
      mayReadTrace: this.may.ream,
    };
    const session = new ReviewSession(id, sources, view.scene);
    view.follow(session, () => this.panes.value[0]?.view === view);
    session.start();
    const mayRead = () => this.may.readCases;
    const liveCase = new LiveCase(session.store, mayRead, this.origin);
    const surroundings = new Surroundings(
      session.store,
      view.scene,
      new MeshLoader(),
      () => mayRead() && view.scene.quality.full.value,
      this.origin,
    );
    const close = () => {
      surroundings.dispose();
      session.dispose();
      view.dispose();
      socket.dispose();
    };
    return { session, view, liveCase, close };
  }
}
