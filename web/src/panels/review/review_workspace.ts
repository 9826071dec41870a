import { signal } from '@preact/signals';

import { SharedCamera } from '../../scene/shared_camera';
import { ReviewView } from '../../scene/review_view';
import type { LiveCase } from '../../state/live_case';
import { ReviewSession, type ReviewSources } from '../../state/review/review_session';
import { ReviewSettings } from '../../state/review/review_settings';

/** What a session that is reviewed comes from, as long as it is shown. */
export interface OpenSources {
  sources: ReviewSources;
  /** What is shown beside the session itself, once there is a picture. */
  follow?(session: ReviewSession, view: ReviewView): { liveCase: LiveCase | null; dispose(): void };
  dispose(): void;
}

/** One session that is reviewed, with its picture. */
export interface Pane {
  session: ReviewSession;
  view: ReviewView;
  /** Null: nothing is known of the case beside the session, so that there are no slices of it. */
  liveCase: LiveCase | null;
  close(): void;
}

/** The sessions that are reviewed beside each other, as long as their page is open. */
export class ReviewWorkspace {
  readonly settings = new ReviewSettings();
  readonly panes = signal<readonly Pane[]>([]);
  private readonly camera = new SharedCamera();

  constructor(
    private readonly openSources: () => OpenSources,
    /** `served`: whether it has a server, with other pages and other sessions. */
    readonly page: { readonly served: boolean; readonly mayAnnotate: boolean },
  ) {}

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
    const opened = this.openSources();
    const session = new ReviewSession(id, opened.sources, view.scene);
    view.follow(session, () => this.panes.value[0]?.view === view);
    session.start();
    const beside = opened.follow?.(session, view) ?? null;
    const close = () => {
      beside?.dispose();
      session.dispose();
      view.dispose();
      opened.dispose();
    };
    return { session, view, liveCase: beside?.liveCase ?? null, close };
  }
}
