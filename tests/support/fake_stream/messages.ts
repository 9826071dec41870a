import { Builder } from 'flatbuffers';
import { MeshoptEncoder } from 'meshoptimizer/encoder';

import {
  Body,
  Hello,
  MeshBlock,
  MeshDelta,
  Pose,
  ServerMessage,
  type SessionState,
  Telemetry,
  Vec3,
} from '../../../web/src/wire/generated/stream_generated';
import { cap, dims, entryMm, plannedDepthMm, type Point, spacingMm } from './bone';
import { blockEdge, type BlockMesh } from './surface_nets';

await MeshoptEncoder.ready;

/** The tool's z is along the axis, which is the grid's -x: a half turn about (1, 0, -1). */
const toolRotation = { w: 0, x: Math.SQRT1_2, y: 0, z: -Math.SQRT1_2 };

export interface HelloOptions {
  sessionId: string;
  serverEpoch: bigint;
  forceScale: number;
}

export interface Moment {
  firstTick: number;
  thrustN: number[];
  handForceN: number[];
  feedMmS: number[];
  densityGCc: number[];
  tick: number;
  apexMm: Point;
  spindleOn: boolean;
  state: SessionState;
  depthMm: number;
  removedMm3: number;
}

export function helloMessage(options: HelloOptions): Uint8Array {
  const b = new Builder(1 << 16);
  const tool = capMesh();
  const sessionId = b.createString(options.sessionId);
  const caseId = b.createString('demo');
  const caseName = b.createString('Made-up scapula');
  const side = b.createString('right');
  const toolName = b.createString('ellipse 18.25,9');
  const gridDims = Hello.createGridDimsVector(b, dims);
  const positions = Hello.createToolPositionsMmVector(b, tool.positionsMm);
  const indices = Hello.createToolIndicesVector(b, tool.indices);
  Hello.startHello(b);
  Hello.addProtocolRevision(b, 1);
  Hello.addSessionId(b, sessionId);
  Hello.addServerEpoch(b, options.serverEpoch);
  Hello.addCaseId(b, caseId);
  Hello.addCaseName(b, caseName);
  Hello.addSide(b, side);
  Hello.addGridDims(b, gridDims);
  Hello.addVoxelSpacingMm(b, Vec3.createVec3(b, ...spacingMm));
  Hello.addWorldFromGrid(b, Pose.createPose(b, 1, 0, 0, 0, -100, 20, 300));
  Hello.addBlockEdgeVoxels(b, blockEdge);
  Hello.addToolPositionsMm(b, positions);
  Hello.addToolIndices(b, indices);
  Hello.addToolName(b, toolName);
  Hello.addAxisEntryMm(b, Vec3.createVec3(b, ...inWorld(entryMm)));
  Hello.addAxisDirection(b, Vec3.createVec3(b, -1, 0, 0));
  Hello.addPlannedDepthMm(b, plannedDepthMm);
  Hello.addForceScale(b, options.forceScale);
  Hello.addForceMaxN(b, 3.3);
  return serverMessage(b, Body.Hello, Hello.endHello(b));
}

export interface RevisedBlock {
  block: number;
  revision: number;
  mesh: BlockMesh;
}

export function meshMessage(blocks: RevisedBlock[], tick: number, keyComplete: boolean): Uint8Array {
  const b = new Builder(1 << 16);
  const offsets = blocks.map(({ block, revision, mesh }) => {
    const empty = mesh.indices.length === 0;
    const vertices = empty
      ? 0
      : bytesVector(b, MeshoptEncoder.encodeVertexBufferLevel(mesh.vertices, mesh.vertexCount, 8, 2, 0));
    const indices = empty
      ? 0
      : bytesVector(b, MeshoptEncoder.encodeIndexBuffer(new Uint8Array(mesh.indices.buffer), mesh.indices.length, 4));
    MeshBlock.startMeshBlock(b);
    MeshBlock.addBlock(b, block);
    MeshBlock.addRevision(b, revision);
    MeshBlock.addTick(b, tick);
    if (!empty) {
      MeshBlock.addVertexCount(b, mesh.vertexCount);
      MeshBlock.addIndexCount(b, mesh.indices.length);
      MeshBlock.addVertices(b, vertices);
      MeshBlock.addIndices(b, indices);
    }
    return MeshBlock.endMeshBlock(b);
  });
  const vector = MeshDelta.createBlocksVector(b, offsets);
  MeshDelta.startMeshDelta(b);
  MeshDelta.addBlocks(b, vector);
  MeshDelta.addKeyComplete(b, keyComplete);
  return serverMessage(b, Body.MeshDelta, MeshDelta.endMeshDelta(b));
}

export function telemetryMessage(m: Moment): Uint8Array {
  const b = new Builder(4096);
  const thrust = Telemetry.createThrustNVector(b, m.thrustN);
  const hand = Telemetry.createHandForceNVector(b, m.handForceN);
  const feed = Telemetry.createFeedRateMmSVector(b, m.feedMmS);
  const density = Telemetry.createDensityGCcVector(b, m.densityGCc);
  const q = toolRotation;
  Telemetry.startTelemetry(b);
  Telemetry.addFirstTick(b, m.firstTick);
  Telemetry.addThrustN(b, thrust);
  Telemetry.addHandForceN(b, hand);
  Telemetry.addFeedRateMmS(b, feed);
  Telemetry.addDensityGCc(b, density);
  Telemetry.addTick(b, m.tick);
  Telemetry.addWorldFromTool(b, Pose.createPose(b, q.w, q.x, q.y, q.z, ...inWorld(m.apexMm)));
  Telemetry.addSpindleOn(b, m.spindleOn);
  Telemetry.addState(b, m.state);
  Telemetry.addDepthMm(b, m.depthMm);
  Telemetry.addRemovedVolumeMm3(b, m.removedMm3);
  Telemetry.addCorticalShare(b, 0.4);
  Telemetry.addTickMeanUs(b, 184);
  Telemetry.addTickP99Us(b, 391);
  return serverMessage(b, Body.Telemetry, Telemetry.endTelemetry(b));
}

function inWorld([x, y, z]: Point): Point {
  return [x - 100, y + 20, z + 300];
}

function bytesVector(b: Builder, bytes: Uint8Array): number {
  b.startVector(1, bytes.length, 8);
  for (let i = bytes.length - 1; i >= 0; --i) b.addInt8(bytes[i] ?? 0);
  return b.endVector();
}

/** The bytes of a message with this body, which was built last. */
export function serverMessage(b: Builder, type: Body, body: number): Uint8Array {
  ServerMessage.startServerMessage(b);
  ServerMessage.addBodyType(b, type);
  ServerMessage.addBody(b, body);
  b.finish(ServerMessage.endServerMessage(b));
  return b.asUint8Array();
}

/** The cap as rings around the tool's z axis, apex at the origin, closed at its back. */
function capMesh(): { positionsMm: number[]; indices: number[] } {
  const rings = 16;
  const sectors = 64;
  const positionsMm: number[] = [0, 0, 0];
  for (let ring = 1; ring <= rings; ++ring)
    for (let sector = 0; sector < sectors; ++sector) {
      const polar = (ring / rings) * (Math.PI / 2);
      const around = (sector / sectors) * 2 * Math.PI;
      const radius = cap.radiusMm * Math.sin(polar);
      positionsMm.push(radius * Math.cos(around), radius * Math.sin(around), cap.heightMm * (Math.cos(polar) - 1));
    }
  positionsMm.push(0, 0, -cap.heightMm);
  const back = positionsMm.length / 3 - 1;
  const at = (ring: number, sector: number) => (ring === 0 ? 0 : 1 + (ring - 1) * sectors + (sector % sectors));
  const indices: number[] = [];
  for (let sector = 0; sector < sectors; ++sector) {
    for (let ring = 0; ring < rings; ++ring) {
      const [a, b, c, d] = [at(ring, sector), at(ring + 1, sector), at(ring + 1, sector + 1), at(ring, sector + 1)];
      indices.push(a, b, c);
      if (ring > 0) indices.push(a, c, d);
    }
    indices.push(back, at(rings, sector + 1), at(rings, sector));
  }
  return { positionsMm, indices };
}
