import type { MeshReport, MeshRequest } from './mesh_worker';
import type { Surface } from './ply';

/** Fetches and reads surfaces off the main thread; a newer request replaces those before it. */
export class MeshLoader {
  private worker: Worker | null = null;
  private newest = 0;

  /** The surface, or null when a newer one was asked for meanwhile. Throws an Error with the reason. */
  load(url: string): Promise<Surface | null> {
    const request: MeshRequest = { id: ++this.newest, url };
    this.worker ??= new Worker(new URL('./mesh_worker.ts', import.meta.url), { type: 'module' });
    const { worker } = this;
    return new Promise((resolve, reject) => {
      const receive = (event: MessageEvent<MeshReport>) => {
        if (event.data.id !== request.id) return;
        worker.removeEventListener('message', receive);
        if (request.id !== this.newest) resolve(null);
        else if ('problem' in event.data) reject(new Error(event.data.problem));
        else resolve(event.data.surface);
      };
      worker.addEventListener('message', receive);
      worker.postMessage(request);
    });
  }

  dispose(): void {
    this.worker?.terminate();
    this.worker = null;
    ++this.newest;
  }
}
