import { LiveCase } from '../../state/live_case';
import { Surroundings } from '../../state/surroundings';
import type { Permissions } from '../../state/permissions';
import { Api } from '../../wire/api';
import { MeshLoader } from '../../wire/mesh_loader';
import type { ReviewApi } from '../../wire/review_api';
import { WorkerStreamSocket } from '../../wire/stream_socket';
import { loadSurface } from '../../wire/surface_loader';
import type { OpenSources } from './review_workspace';

/** Sessions of the server that this page comes from. */
export function servedSources(origin: string, review: ReviewApi, may: Permissions): OpenSources {
  // What is measured here is measured on all that there is.
  const socket = new WorkerStreamSocket(false);
  return {
    sources: {
      api: new Api(origin),
      review,
      socket,
      surface: (of, onProgress, abort) =>
        loadSurface({ url: review.meshUrl(of), jobs: review.jobsUrl() }, onProgress, abort),
      mayReadTrace: may.ream,
    },
    follow(session, view) {
      const mayRead = () => may.readCases;
      const liveCase = new LiveCase(session.store, mayRead, origin);
      const surroundings = new Surroundings(
        session.store,
        view.scene,
        new MeshLoader(),
        () => mayRead() && view.scene.quality.full.value,
        origin,
      );
      return { liveCase, dispose: () => surroundings.dispose() };
    },
    dispose: () => socket.dispose(),
  };
}
