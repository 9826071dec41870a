import type { BoneScene } from './scene/scene';
import type { Store } from './state/store';

/** What browser tests read as `window.__ream`; a snapshot at each reading. */
export interface DebugReadout {
  framesDrawn: number;
  blocks: number;
  triangles: number;
  link: string;
  live: boolean;
  sessionId: string | null;
  sessionState: string | null;
  serverEpoch: string | null;
  lastTick: number | null;
  traceRevision: number;
  replayOf: string | null;
  positionTicks: number | null;
}

declare global {
  interface Window {
    __ream: DebugReadout;
  }
}

export function publishDebugReadout(store: Store, scene: BoneScene): void {
  Object.defineProperty(window, '__ream', {
    get: (): DebugReadout => ({
      framesDrawn: scene.framesDrawn,
      blocks: scene.blockCount,
      triangles: scene.triangleCount,
      link: store.link.value.kind,
      live: store.live.value,
      sessionId: store.sessionId.value,
      sessionState: store.sessionState.value,
      serverEpoch: store.hello.value?.serverEpoch ?? null,
      lastTick: store.telemetry.value?.tick ?? null,
      traceRevision: store.traceRevision.value,
      replayOf: store.hello.value?.replayOf ?? null,
      positionTicks: store.playback.value?.positionTicks ?? null,
    }),
  });
}
