import { readPly, type Surface } from './ply';

/** Page to worker: fetch this surface. */
export interface MeshRequest {
  id: number;
  url: string;
}
/** Worker to page. */
export type MeshReport = { id: number; surface: Surface } | { id: number; problem: string };

async function fetchSurface({ id, url }: MeshRequest): Promise<void> {
  const response = await fetch(url, { cache: 'no-cache' });
  if (!response.ok) {
    const body = (await response.json().catch(() => null)) as { detail?: string } | null;
    throw new Error(body?.detail ?? String(response.status));
  }
  const surface = readPly(await response.arrayBuffer());
  const { positions, normals, indices } = surface;
  const report: MeshReport = { id, surface };
  self.postMessage(report, { transfer: [positions.buffer, normals.buffer, indices.buffer] });
}

self.onmessage = (event: MessageEvent<MeshRequest>) => {
  fetchSurface(event.data).catch((error: unknown) => {
    const report: MeshReport = { id: event.data.id, problem: error instanceof Error ? error.message : String(error) };
    self.postMessage(report);
  });
};
