import type { DeviceReport, Feedback, SteeringInput } from '../../src/wire/device_messages';
import type { DeviceHandlers, DeviceSocket } from '../../src/wire/device_socket';

/** A device connection whose server is the test. */
export class FakeDeviceSocket implements DeviceSocket {
  readonly opened: string[] = [];
  readonly inputs: SteeringInput[] = [];
  closed = 0;
  handlers: DeviceHandlers | null = null;

  open(url: string, handlers: DeviceHandlers): void {
    this.opened.push(url);
    this.handlers = handlers;
  }
  steer(input: SteeringInput): void {
    this.inputs.push(input);
  }
  close(): void {
    ++this.closed;
    this.handlers = null;
  }
}

export function welcome(protocolRevision = 1): DeviceReport {
  return { kind: 'welcome', welcome: { protocolRevision, sessionId: 's1', device: 'browser' } };
}

export function feedback(change: Partial<Feedback> = {}): DeviceReport {
  const idleFeedback: Feedback = {
    sequence: 1,
    stampUs: 1n,
    tick: 1,
    sentMs: null,
    link: 'fresh',
    thrustN: 0,
    vibrationG: 0,
    engaged: false,
    rttMs: 1,
  };
  return { kind: 'feedback', feedback: { ...idleFeedback, ...change } };
}
