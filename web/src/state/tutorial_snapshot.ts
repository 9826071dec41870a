import type { Vector3 } from 'three';

import type { InputKind } from '../practice/last_input';
import { standingSpindleRadS, type Telemetry } from '../wire/telemetry';
import type { PracticeStore } from './practice_store';
import type { Store } from './store';
import { toolOnPlan } from './tool_on_plan';
import type { TutorialSnapshot } from './tutorial';

/** From where the picture is seen. */
export interface TutorialEye {
  /** Unit. */
  towardsEye: Vector3;
  distanceMm: number;
}

/** What a tutorial has to remember of the moments before. */
export interface TutorialMemory {
  /** From where the picture was seen at first. */
  eye: TutorialEye;
  mostTurnedDeg: number;
  zoomed: number;
  deepestMm: number;
}

export function freshMemory(eye: TutorialEye): TutorialMemory {
  return { eye, mostTurnedDeg: 0, zoomed: 1, deepestMm: -Infinity };
}

interface Sources {
  store: Store;
  practice: PracticeStore;
  input: InputKind;
  eye: TutorialEye;
}

/** What holds now in `session`; what is to be remembered is added to `memory`. */
export function snapshotOf(session: string, memory: TutorialMemory, sources: Sources): TutorialSnapshot {
  const { store, practice, input } = sources;
  const { hand } = practice;
  const hello = store.hello.value;
  const telemetry = hello?.sessionId === session ? store.telemetry.value : null;
  const state = store.sessionState.value;
  const ended = state !== null && state !== 'created' && !store.active.value;
  const tool = hello === null || telemetry === null ? null : toolOnPlan(hello, telemetry);
  memory.deepestMm = Math.max(memory.deepestMm, tool?.depthMm ?? -Infinity);
  const lean = Math.hypot(hand.lean.value.superior, hand.lean.value.anterior);
  return {
    steering: practice.sessionId.value === session,
    ended,
    failed: state === 'fault' || state === 'interrupted',
    canZoom: input === 'mouse' || input === 'keys',
    ...seen(memory, sources.eye),
    besideMm: Math.max(practice.offPlanMm.value, tool?.besideMm ?? 0),
    leanDeg: Math.max(lean, tool?.leanDeg ?? 0),
    spindleOn: hand.spindleOn.value,
    stalled: telemetry?.stalled ?? false,
    irrigating: hand.irrigating.value,
    spindleTurns: telemetry !== null && telemetry.spindleOn && telemetry.spindleSpeedRadS > standingSpindleRadS,
    touching: (telemetry?.densityGCc ?? 0) > 0,
    pushN: hand.pushN.value,
    thrustN: telemetry === null ? 0 : meanThrustN(telemetry, practice.feedback.value?.thrustN ?? 0),
    depthMm: telemetry?.depthMm ?? 0,
    plannedMm: hello?.plannedDepthMm ?? 0,
    drawnBackMm: tool === null ? 0 : memory.deepestMm - tool.depthMm,
  };
}

function seen(memory: TutorialMemory, now: TutorialEye) {
  const turnedDeg = (memory.eye.towardsEye.angleTo(now.towardsEye) * 180) / Math.PI;
  const ratio = now.distanceMm / memory.eye.distanceMm;
  memory.mostTurnedDeg = Math.max(memory.mostTurnedDeg, turnedDeg);
  memory.zoomed = Math.max(memory.zoomed, ratio, 1 / ratio);
  return { turnedDeg, mostTurnedDeg: memory.mostTurnedDeg, zoomed: memory.zoomed };
}

/** Of the newest batch, since single samples tremble with the drill. */
function meanThrustN({ thrustN }: Telemetry, otherwiseN: number): number {
  if (thrustN.length === 0) return otherwiseN;
  return thrustN.reduce((sum, newtons) => sum + newtons, 0) / thrustN.length;
}
