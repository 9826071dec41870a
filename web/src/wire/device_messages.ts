import type { Triple } from './messages';

/** The device protocol this page speaks; see proto/device.fbs. */
export const deviceProtocolRevision = 1;

/** What the person wants the simulated hand to do; world frame. */
export interface SteeringInput {
  /** From the planned entry, square to the planned axis. */
  sidewaysMm: Triple;
  /** Where the tool's axis should point, of any length but 0. */
  lean: Triple;
  /** Simulated N along the axis, negative to withdraw. */
  pushN: number;
  spindleOn: boolean;
  irrigating: boolean;
  paused: boolean;
  /** Somebody holds the tool (the deadman button). */
  held: boolean;
}

/** How the server takes the newest input: used, a little old, too old so that the force fades, or none for too long. */
export type PoseLink = 'fresh' | 'held' | 'fading' | 'lost';

export interface Welcome {
  protocolRevision: number;
  sessionId: string;
  device: string;
}

export interface Feedback {
  /** Newest input that the server has taken. */
  sequence: number;
  /** The server's clock. */
  stampUs: bigint;
  /** Newest tick by then. */
  tick: number;
  /** When the input of `sequence` was sent, ms since 1970 by this computer's clock; null where that was long ago. */
  sentMs: number | null;
  link: PoseLink;
  thrustN: number;
  vibrationG: number;
  /** The reamer touches bone. */
  engaged: boolean;
  /** There and back; null while it is not known. */
  rttMs: number | null;
}

export type DeviceReport = { kind: 'welcome'; welcome: Welcome } | { kind: 'feedback'; feedback: Feedback };

/** Page to worker. Each `open` closes what was open before; `connection` numbers the answers. */
export type DeviceWorkerRequest =
  { kind: 'open'; connection: number; url: string } | { kind: 'steer'; input: SteeringInput } | { kind: 'close' };

/** Worker to page. `closed` comes once per opened connection that was not closed by request. */
export type DeviceWorkerReport =
  | { kind: 'report'; connection: number; report: DeviceReport }
  | { kind: 'closed'; connection: number; code: number; reason: string };
