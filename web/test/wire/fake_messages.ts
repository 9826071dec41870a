import type { Hello, StreamMessage, Telemetry } from '../../src/wire/messages';

export function hello(changes: Partial<Hello> = {}): StreamMessage {
  const pose = { rotationXyzw: [0, 0, 0, 1], translationMm: [0, 0, 0] } as const;
  return {
    kind: 'hello',
    hello: {
      protocolRevision: 1,
      sessionId: 'a',
      serverEpoch: '1',
      caseId: 'demo',
      caseName: 'Demo',
      side: 'right',
      gridDims: [64, 64, 64],
      voxelSpacingMm: [1, 1, 1],
      worldFromGrid: pose,
      blockEdgeVoxels: 32,
      tool: { name: '', positionsMm: new Float32Array(), indices: new Uint32Array() },
      axisEntryMm: [0, 0, 0],
      axisDirection: [1, 0, 0],
      plannedDepthMm: 2,
      forceScale: 26,
      handForceMaxN: 3,
      replayOf: '',
      durationTicks: 0,
      scapula: null,
      ...changes,
    },
  };
}

export function telemetry(changes: Partial<Telemetry> = {}): StreamMessage {
  return {
    kind: 'telemetry',
    telemetry: {
      firstTick: 0,
      tickStride: 1,
      thrustN: new Float32Array(),
      feedRatesMmS: new Float32Array(),
      vibrationG: new Float32Array(),
      stampMs: 0,
      tick: 0,
      handForceN: 0,
      torqueNMm: 0,
      feedRateMmS: 0,
      densityGCc: 0,
      worldFromTool: null,
      worldFromHandle: null,
      spindleOn: false,
      spindleSpeedRadS: 16.3,
      stalled: false,
      irrigating: false,
      surfaceTemperatureC: null,
      state: 'running',
      depthMm: 0,
      removedVolumeMm3: 0,
      corticalShare: 0,
      dropped: 0,
      tickMeanUs: 0,
      tickP99Us: 0,
      ticksMissed: 0,
      fault: '',
      worldFromBoneRest: null,
      playback: null,
      ...changes,
    },
  };
}

export const wholePicture: StreamMessage = { kind: 'mesh', mesh: { blocks: [], keyComplete: true } };
