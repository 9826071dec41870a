import type { BoneScene } from './scene/scene';
import type { PracticeStore } from './state/practice_store';
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
  /** Steering from this page: state of the device's connection, else null. */
  deviceLink: string | null;
  pushN: number;
}

declare global {
  interface Window {
    __ream: DebugReadout;
  }
}

export function publishDebugReadout(store: Store, practice: PracticeStore, scene: BoneScene): void {
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
      deviceLink: practice.sessionId.value === null ? null : practice.link.value.kind,
      pushN: practice.hand.pushN.value,
    }),
  });
}
