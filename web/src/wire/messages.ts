import type { Pose, Triple } from './pose';
import type { Playback, SessionState, Telemetry } from './telemetry';

/**
 * What the stream worker hands to the page, decoded. Lengths mm, forces N, times in ticks of 1 ms; the world frame is
 * the CT's LPS (x to the patient's left, y posterior, z superior).
 */

/** The stream this page understands; see Hello.protocol_revision in proto/stream.fbs. */
export const protocolRevision = 1;

export type { Playback, SessionState, Telemetry, Pose, Triple };

export interface ToolMesh {
  name: string;
  /** Three per vertex, tool frame: z into the bone, origin at the apex. */
  positionsMm: Float32Array<ArrayBuffer>;
  indices: Uint32Array<ArrayBuffer>;
}

export interface Hello {
  protocolRevision: number;
  sessionId: string;
  /** Changes when the server restarts. */
  serverEpoch: string;
  caseId: string;
  caseName: string;
  side: string;
  gridDims: Triple;
  voxelSpacingMm: Triple;
  worldFromGrid: Pose;
  blockEdgeVoxels: number;
  tool: ToolMesh;
  axisEntryMm: Triple;
  /** Unit, into the bone. */
  axisDirection: Triple;
  plannedDepthMm: number;
  /** Simulated newtons per newton at the hand. */
  forceScale: number;
  handForceMaxN: number;
  /** The session that was recorded; empty: this is no replay but live. */
  replayOf: string;
  /** Of the recording, 0 for what is live. */
  durationTicks: number;
  /** How the scapula lies; null where the case does not say. */
  scapula: ScapulaPoints | null;
}

/** Landmarks of the scapula, mm. */
export interface ScapulaPoints {
  glenoidCentreMm: Triple;
  trigonumMm: Triple;
  inferiorAngleMm: Triple;
}

/** Whether it is of two plates for a study of feel: no shoulder. */
export const isTwoPlates = ({ caseId }: Pick<Hello, 'caseId'>): boolean => caseId.startsWith('two-plates-');

/** The surface of one block; no vertices means that the block is empty now. */
export interface BlockSurface {
  /** x + blocksX * (y + blocksY * z). */
  block: number;
  revision: number;
  tick: number;
  /** Four per vertex: x, y, z in 1/1024 voxel from the block's origin minus one voxel, then padding. */
  positions: Uint16Array<ArrayBuffer>;
  /**
   * Four per vertex: a direction in signed 1/32767, voxel frame, see stretchedNormals; then what is known of the bone
   * there, see bone_marks.
   */
  normals: Int16Array<ArrayBuffer>;
  /** Triangles, counter-clockwise from outside. */
  indices: Uint16Array<ArrayBuffer> | Uint32Array<ArrayBuffer>;
}

export interface MeshDelta {
  blocks: BlockSurface[];
  keyComplete: boolean;
  /** Surfaces of fewer triangles come soon for all that has come so far. */
  simplerFollow?: boolean;
}

export type StreamMessage =
  | { kind: 'hello'; hello: Hello }
  | { kind: 'mesh'; mesh: MeshDelta }
  /** Of no message of the server: takes the place of surfaces that it has sent, of the same revisions. */
  | { kind: 'simpler'; blocks: BlockSurface[] }
  | { kind: 'telemetry'; telemetry: Telemetry }
  | { kind: 'tool'; tool: ToolMesh };

/** Page to worker. Each `open` closes what was open before; `connection` numbers the answers. */
export type WorkerRequest = { kind: 'open'; connection: number; url: string; simplifies: boolean } | { kind: 'close' };

/** Worker to page. `closed` comes once per opened connection that was not closed by request. */
export type WorkerReport =
  | { kind: 'message'; connection: number; message: StreamMessage }
  | { kind: 'closed'; connection: number; reason: string };
