import { ByteBuffer } from 'flatbuffers';

import { decodeBlock } from './decode_block';
import { Body } from './generated/ream/wire/body';
import { Hello as WireHello } from './generated/ream/wire/hello';
import { MeshDelta as WireMeshDelta } from './generated/ream/wire/mesh-delta';
import { ServerMessage } from './generated/ream/wire/server-message';
import { Telemetry as WireTelemetry } from './generated/ream/wire/telemetry';
import { ToolChange } from './generated/ream/wire/tool-change';
import type { BlockSurface, Hello, MeshDelta, ScapulaPoints, StreamMessage, ToolMesh } from './messages';
import { pose, triple, type Triple } from './pose';
import type { SurfaceSimplifier } from './surface_simplifier';
import { decodeTelemetry } from './telemetry';

/** Decodes one connection's messages in order; the first must be the hello. Throws on anything else. */
export class StreamDecoder {
  private voxelSpacingMm: Triple | null = null;
  private simplifier: SurfaceSimplifier | null = null;

  /** `Simplifier`: surfaces come of fewer triangles, of the first picture later by goOn(); null: as they are. */
  constructor(private readonly Simplifier: typeof SurfaceSimplifier | null = null) {}

  decode(bytes: Uint8Array): StreamMessage {
    const message = ServerMessage.getRootAsServerMessage(new ByteBuffer(bytes));
    const type = message.bodyType();
    if (type === Body.Hello) {
      const hello = decodeHello(requireTable(message.body(new WireHello()) as WireHello | null));
      this.voxelSpacingMm = hello.voxelSpacingMm;
      this.simplifier = this.Simplifier === null ? null : new this.Simplifier(hello.voxelSpacingMm);
      return { kind: 'hello', hello };
    }
    if (this.voxelSpacingMm === null) throw new Error('the stream did not begin with a hello');
    if (type === Body.MeshDelta) {
      const delta = requireTable(message.body(new WireMeshDelta()) as WireMeshDelta | null);
      const mesh = decodeMesh(delta, this.voxelSpacingMm);
      return { kind: 'mesh', mesh: this.simplifier?.passOn(mesh) ?? mesh };
    }
    if (type === Body.Telemetry) {
      const telemetry = requireTable(message.body(new WireTelemetry()) as WireTelemetry | null);
      return { kind: 'telemetry', telemetry: decodeTelemetry(telemetry) };
    }
    if (type === Body.ToolChange) {
      return { kind: 'tool', tool: decodeTool(requireTable(message.body(new ToolChange()) as ToolChange | null)) };
    }
    throw new Error(`message of unknown type ${String(type)}`);
  }

  /** Whether goOn() is to be called again. */
  get works(): boolean {
    return this.simplifier?.works ?? false;
  }

  /** After `simplerFollow`: works for about so long; what has come of it, once that is all. */
  goOn(ms: number): StreamMessage | null {
    const blocks = this.simplifier?.work(ms) ?? null;
    return blocks === null ? null : { kind: 'simpler', blocks };
  }
}

/** The buffers of a message that can change threads without being copied. */
export function transferables(message: StreamMessage): ArrayBuffer[] {
  switch (message.kind) {
    case 'hello':
      return [message.hello.tool.positionsMm.buffer, message.hello.tool.indices.buffer];
    case 'mesh':
      return buffersOf(message.mesh.blocks);
    case 'simpler':
      return buffersOf(message.blocks);
    case 'telemetry':
      return [
        message.telemetry.thrustN.buffer,
        message.telemetry.feedRatesMmS.buffer,
        message.telemetry.vibrationG.buffer,
      ];
    case 'tool':
      return [message.tool.positionsMm.buffer, message.tool.indices.buffer];
  }
}

const buffersOf = (blocks: readonly BlockSurface[]) =>
  blocks.flatMap((b) => [b.positions.buffer, b.normals.buffer, b.indices.buffer]);

function decodeHello(hello: WireHello): Hello {
  return {
    protocolRevision: hello.protocolRevision(),
    sessionId: hello.sessionId() ?? '',
    serverEpoch: hello.serverEpoch().toString(),
    caseId: hello.caseId() ?? '',
    caseName: hello.caseName() ?? '',
    side: hello.side() ?? '',
    gridDims: [hello.gridDims(0) ?? 0, hello.gridDims(1) ?? 0, hello.gridDims(2) ?? 0],
    voxelSpacingMm: triple(hello.voxelSpacingMm(), [1, 1, 1]),
    worldFromGrid: pose(hello.worldFromGrid()) ?? { rotationXyzw: [0, 0, 0, 1], translationMm: [0, 0, 0] },
    blockEdgeVoxels: hello.blockEdgeVoxels(),
    tool: decodeTool(hello),
    axisEntryMm: triple(hello.axisEntryMm(), [0, 0, 0]),
    axisDirection: triple(hello.axisDirection(), [1, 0, 0]),
    plannedDepthMm: hello.plannedDepthMm(),
    forceScale: hello.forceScale(),
    handForceMaxN: hello.forceMaxN(),
    replayOf: hello.replayOf() ?? '',
    durationTicks: hello.durationTicks(),
    scapula: scapulaOf(hello),
  };
}

function scapulaOf(hello: WireHello): ScapulaPoints | null {
  const centre = hello.glenoidCentreMm();
  const trigonum = hello.trigonumMm();
  const angle = hello.inferiorAngleMm();
  if (centre === null || trigonum === null || angle === null) return null;
  return {
    glenoidCentreMm: triple(centre, [0, 0, 0]),
    trigonumMm: triple(trigonum, [0, 0, 0]),
    inferiorAngleMm: triple(angle, [0, 0, 0]),
  };
}

function decodeTool(message: WireHello | ToolChange): ToolMesh {
  return {
    name: message.toolName() ?? '',
    positionsMm: Float32Array.from(message.toolPositionsMmArray() ?? []),
    indices: Uint32Array.from(message.toolIndicesArray() ?? []),
  };
}

function decodeMesh(delta: WireMeshDelta, voxelSpacingMm: Triple): MeshDelta {
  const blocks = [];
  for (let i = 0; i < delta.blocksLength(); ++i) {
    blocks.push(decodeBlock(requireTable(delta.blocks(i)), voxelSpacingMm));
  }
  return { blocks, keyComplete: delta.keyComplete() };
}

function requireTable<T>(table: T | null): T {
  if (table === null) throw new Error('a message lacks its body');
  return table;
}
