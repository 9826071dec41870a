import { Builder, ByteBuffer } from 'flatbuffers';
import type { RawData, WebSocket } from 'ws';

import {
  Button,
  DeviceBody,
  DeviceHello,
  DeviceMessage,
  Feedback,
  LinkState,
  SessionState,
  Steering,
  Vec3,
  Welcome,
} from '../../../web/src/wire/generated/device_generated';
import type { Point } from './bone';

const fadeMs = 100;
const lostMs = 250;
const approachMmS = 6;
/** Feed of 52 N with the spindle on. */
const feedMmS = 0.4;
const startMm = -10;

/** The simulated hand of the fake server: goes where the newest Steering wants it, answers each with a Feedback. */
export class FakeHand {
  depthMm = startMm;
  thrustN = 0;
  sidewaysMm: Point = [0, 0, 0];
  spindleOn = false;
  link: 'fresh' | 'fading' | 'lost' = 'lost';
  private peer: WebSocket | null = null;
  private pushN = 0;
  private paused = false;
  private sequence = 0;
  private heardMs = -Infinity;
  private rttMs = -1;

  constructor(private readonly sessionId: string) {}

  get resting(): boolean {
    return this.paused || this.link === 'lost';
  }

  /** A newer client takes the place of the one before. */
  take(peer: WebSocket): void {
    this.peer?.close(4001, 'another page has taken the reamer');
    this.peer = peer;
    peer.on('message', (data: RawData) => {
      if (this.peer === peer) this.hear(peer, new Uint8Array(data as Buffer));
    });
  }

  advance(ms: number): void {
    const age = Date.now() - this.heardMs;
    this.link = age >= lostMs ? 'lost' : age >= fadeMs ? 'fading' : 'fresh';
    const pushN = this.resting ? 0 : this.pushN;
    this.thrustN = this.depthMm >= 0 ? Math.max(pushN, 0) : 0;
    if (pushN < 0) this.depthMm = Math.max(this.depthMm - (approachMmS * ms) / 1000, startMm);
    else if (pushN > 0 && this.depthMm < 0) this.depthMm = Math.min(this.depthMm + (approachMmS * ms) / 1000, 0);
    else if (pushN > 0 && this.spindleOn) this.depthMm += (feedMmS * (pushN / 52) * ms) / 1000;
  }

  private hear(peer: WebSocket, bytes: Uint8Array): void {
    const message = DeviceMessage.getRootAsDeviceMessage(new ByteBuffer(bytes));
    if (message.bodyType() === DeviceBody.DeviceHello) {
      const hello = message.body(new DeviceHello()) as DeviceHello;
      if (hello.protocolRevision() !== 1) throw new Error(`device protocol ${hello.protocolRevision()}`);
      peer.send(this.welcome());
      return;
    }
    if (message.bodyType() !== DeviceBody.Steering) throw new Error('a browser sends Steering');
    const steering = message.body(new Steering()) as Steering;
    this.sequence = steering.sequence();
    this.heardMs = Date.now();
    this.pushN = steering.pushN();
    this.spindleOn = (steering.buttons() & Button.spindle) !== 0;
    this.paused = (steering.buttons() & Button.pause) !== 0;
    const sideways = steering.sidewaysMm();
    if (sideways !== null) this.sidewaysMm = [sideways.x(), sideways.y(), sideways.z()];
    if (steering.echoUs() > 0n)
      this.rttMs = Math.max((Date.now() * 1000 - Number(steering.echoUs()) - steering.echoAgeUs()) / 1000, 0);
    peer.send(this.feedback());
  }

  private welcome(): Uint8Array {
    const b = new Builder(256);
    const sessionId = b.createString(this.sessionId);
    const device = b.createString('browser');
    Welcome.startWelcome(b);
    Welcome.addProtocolRevision(b, 1);
    Welcome.addSessionId(b, sessionId);
    Welcome.addDevice(b, device);
    Welcome.addFadeMs(b, fadeMs);
    Welcome.addLostMs(b, lostMs);
    return finish(b, DeviceBody.Welcome, Welcome.endWelcome(b));
  }

  private feedback(): Uint8Array {
    const b = new Builder(256);
    Feedback.startFeedback(b);
    Feedback.addSequence(b, this.sequence);
    Feedback.addStampUs(b, BigInt(Date.now()) * 1000n);
    Feedback.addLink(b, { fresh: LinkState.fresh, fading: LinkState.fading, lost: LinkState.lost }[this.link]);
    Feedback.addState(b, this.resting ? SessionState.paused : SessionState.running);
    Feedback.addForceN(b, Vec3.createVec3(b, 0, 0, 0));
    Feedback.addThrustN(b, this.thrustN);
    Feedback.addVibrationG(b, this.spindleOn && this.thrustN > 0 ? 0.35 : 0);
    Feedback.addEngaged(b, this.depthMm >= 0);
    Feedback.addRttMs(b, this.rttMs);
    return finish(b, DeviceBody.Feedback, Feedback.endFeedback(b));
  }
}

function finish(b: Builder, type: DeviceBody, body: number): Uint8Array {
  DeviceMessage.startDeviceMessage(b);
  DeviceMessage.addBodyType(b, type);
  DeviceMessage.addBody(b, body);
  b.finish(DeviceMessage.endDeviceMessage(b));
  return b.asUint8Array();
}
