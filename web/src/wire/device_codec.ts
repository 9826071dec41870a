import { Builder, ByteBuffer } from 'flatbuffers';

import { Button } from './generated/ream/wire/button';
import { DeviceBody } from './generated/ream/wire/device-body';
import { DeviceHello } from './generated/ream/wire/device-hello';
import { DeviceMessage } from './generated/ream/wire/device-message';
import { Feedback as WireFeedback } from './generated/ream/wire/feedback';
import { LinkState as WireLink } from './generated/ream/wire/link-state';
import { Steering } from './generated/ream/wire/steering';
import { Vec3 } from './generated/ream/wire/vec3';
import { Welcome as WireWelcome } from './generated/ream/wire/welcome';
import {
  deviceProtocolRevision,
  type DeviceReport,
  type Feedback,
  type PoseLink,
  type Welcome,
  type SteeringInput,
} from './device_messages';

/** The greeting that begins a connection. */
export function encodeHello(name: string): Uint8Array<ArrayBuffer> {
  const b = new Builder(128);
  const nameAt = b.createString(name);
  DeviceHello.startDeviceHello(b);
  DeviceHello.addProtocolRevision(b, deviceProtocolRevision);
  DeviceHello.addName(b, nameAt);
  return finish(b, DeviceBody.DeviceHello, DeviceHello.endDeviceHello(b));
}

/** When a message is sent, and the newest feedback that the page had by then. */
export interface SteeringTimes {
  sequence: number;
  /** The page's clock. */
  sentUs: bigint;
  /** Stamp of that feedback; 0: none. */
  echoUs: bigint;
  /** How long the page has had it. */
  echoAgeUs: number;
}

export function encodeSteering(input: SteeringInput, times: SteeringTimes): Uint8Array<ArrayBuffer> {
  const b = new Builder(160);
  Steering.startSteering(b);
  Steering.addSequence(b, times.sequence);
  Steering.addSentUs(b, times.sentUs);
  Steering.addEchoUs(b, times.echoUs);
  Steering.addEchoAgeUs(b, times.echoAgeUs);
  Steering.addSidewaysMm(b, Vec3.createVec3(b, ...input.sidewaysMm));
  Steering.addLean(b, Vec3.createVec3(b, ...input.lean));
  Steering.addPushN(b, input.pushN);
  Steering.addButtons(b, buttons(input));
  return finish(b, DeviceBody.Steering, Steering.endSteering(b));
}

/** Throws on anything that a server does not send to a device. */
export function decodeDeviceMessage(bytes: Uint8Array): DeviceReport {
  const message = DeviceMessage.getRootAsDeviceMessage(new ByteBuffer(bytes));
  if (message.bodyType() === DeviceBody.Welcome) {
    const welcome = message.body(new WireWelcome()) as WireWelcome | null;
    if (welcome !== null) return { kind: 'welcome', welcome: decodeWelcome(welcome) };
  } else if (message.bodyType() === DeviceBody.Feedback) {
    const feedback = message.body(new WireFeedback()) as WireFeedback | null;
    if (feedback !== null) return { kind: 'feedback', feedback: decodeFeedback(feedback) };
  }
  throw new Error(`device message of type ${String(message.bodyType())} from the server`);
}

function buttons(input: SteeringInput): Button {
  return (
    (input.spindleOn ? Button.spindle : 0) |
    (input.irrigating ? Button.irrigate : 0) |
    (input.paused || !input.held ? Button.pause : 0) |
    (input.held ? Button.deadman : 0)
  );
}

function decodeWelcome(w: WireWelcome): Welcome {
  return { protocolRevision: w.protocolRevision(), sessionId: w.sessionId() ?? '', device: w.device() ?? '' };
}

function decodeFeedback(f: WireFeedback): Feedback {
  return {
    sequence: f.sequence(),
    stampUs: f.stampUs(),
    tick: f.tick(),
    sentMs: null,
    link: poseLink(f.link()),
    thrustN: f.thrustN(),
    vibrationG: f.vibrationG(),
    engaged: f.engaged(),
    rttMs: f.rttMs() < 0 ? null : f.rttMs(),
  };
}

function poseLink(link: WireLink): PoseLink {
  switch (link) {
    case WireLink.fresh:
      return 'fresh';
    case WireLink.held:
      return 'held';
    case WireLink.fading:
      return 'fading';
    case WireLink.lost:
      return 'lost';
    default:
      throw new Error(`unknown link state ${String(link)}`);
  }
}

function finish(b: Builder, type: DeviceBody, body: number): Uint8Array<ArrayBuffer> {
  DeviceMessage.startDeviceMessage(b);
  DeviceMessage.addBodyType(b, type);
  DeviceMessage.addBody(b, body);
  b.finish(DeviceMessage.endDeviceMessage(b));
  return Uint8Array.from(b.asUint8Array());
}
