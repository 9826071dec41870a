import { allDrawn } from './scene/frame_request';
import type { BoneScene } from './scene/scene';
import type { Eye } from './scene/shared_eye';
import type { SoundParameters } from './sound/reaming_sound';
import type { Latency } from './state/latency';
import type { PracticeStore } from './state/practice_store';
import type { Sound } from './state/sound';
import type { Store } from './state/store';
import { toolOnPlan } from './state/tool_on_plan';

/** What browser tests read as `window.__ream`; a snapshot at each reading. */
export interface DebugReadout {
  framesDrawn: number;
  allDrawn: typeof allDrawn;
  blocks: number;
  triangles: number;
  /** The whole bone is there, and is soon of fewer triangles. */
  simplerDue: boolean;
  link: string;
  live: boolean;
  sessionId: string | null;
  sessionState: string | null;
  serverEpoch: string | null;
  lastTick: number | null;
  /** When the last telemetry arrived, ms; a paused replay sends it again and again, too. */
  telemetryMs: number | null;
  traceRevision: number;
  /** How old news are beyond what they always are, ms. */
  behindMs: number;
  replayOf: string | null;
  positionTicks: number | null;
  /** Steering from this page: state of the device's connection, else null. */
  deviceLink: string | null;
  pushN: number;
  /** Also where theatre shows no numbers, mm³. */
  removedMm3: number | null;
  /** How far the reamer's origin is past the planned entry along the axis, mm. */
  toolDepthMm: number | null;
  /** The newest parameters of the sound. */
  sound: SoundParameters;
  /** From where the picture is seen. */
  eye: Eye;
  /** Of a hand on this page: p95 from its sample to the picture of it, ms. */
  handLatencyMs: number | null;
}

declare global {
  interface Window {
    __ream: DebugReadout;
  }
}

interface Sources {
  store: Store;
  practice: PracticeStore;
  scene: BoneScene;
  sound: Sound;
  latency: Latency;
}

export function publishDebugReadout({ store, practice, scene, sound, latency }: Sources): void {
  Object.defineProperty(window, '__ream', {
    get: (): DebugReadout => ({
      framesDrawn: scene.framesDrawn,
      allDrawn,
      blocks: scene.blockCount,
      triangles: scene.triangleCount,
      simplerDue: scene.simplerDue,
      link: store.link.value.kind,
      live: store.live.value,
      sessionId: store.sessionId.value,
      sessionState: store.sessionState.value,
      serverEpoch: store.hello.value?.serverEpoch ?? null,
      lastTick: store.telemetry.value?.tick ?? null,
      telemetryMs: store.telemetry.value?.receivedMs ?? null,
      traceRevision: store.traceRevision.value,
      behindMs: store.behindMs.value,
      replayOf: store.hello.value?.replayOf ?? null,
      positionTicks: store.playback.value?.positionTicks ?? null,
      deviceLink: practice.sessionId.value === null ? null : practice.link.value.kind,
      pushN: practice.hand.pushN.value,
      removedMm3: store.telemetry.value?.removedVolumeMm3 ?? null,
      toolDepthMm: toolDepthMm(store),
      sound: sound.parameters.value,
      eye: scene.eye(),
      handLatencyMs: latency.handMs.value,
    }),
  });
}

function toolDepthMm(store: Store): number | null {
  const hello = store.hello.value;
  const telemetry = store.telemetry.value;
  return hello === null || telemetry === null ? null : (toolOnPlan(hello, telemetry)?.depthMm ?? null);
}
