// The golden messages were made from proto/golden/*.json by `flatc -b`, so nothing here was written by the code that
// reads it.
import { ByteBuffer } from 'flatbuffers';
import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';

import { decodeDeviceMessage, encodeHello, encodeSteering } from '../../src/wire/device_codec';
import { Button, DeviceBody, DeviceHello, DeviceMessage, Steering } from '../../src/wire/generated/device_generated';

const file = (name: string) => readFileSync(new URL(`../../../proto/golden/${name}`, import.meta.url));
const golden = (name: string) => new Uint8Array(file(`${name}.bin`));

function read<T>(bytes: Uint8Array, type: DeviceBody, body: T): T {
  const message = DeviceMessage.getRootAsDeviceMessage(new ByteBuffer(bytes));
  expect(message.bodyType()).toBe(type);
  const found: unknown = message.body(body);
  if (found === null) throw new Error('a message lacks its body');
  return found as T;
}

/** All that a Steering says. */
function decoded(bytes: Uint8Array) {
  const s = read(bytes, DeviceBody.Steering, new Steering());
  const [sideways, lean] = [s.sidewaysMm(), s.lean()];
  return {
    sequence: s.sequence(),
    sentUs: s.sentUs(),
    echoUs: s.echoUs(),
    echoAgeUs: s.echoAgeUs(),
    sideways: [sideways?.x(), sideways?.y(), sideways?.z()],
    lean: [lean?.x(), lean?.y(), lean?.z()],
    pushN: s.pushN(),
    buttons: s.buttons(),
  };
}

describe('device messages', () => {
  it('writes a Steering as the schema has it', () => {
    const input = {
      sidewaysMm: [1.5, -2.5, 0],
      lean: [0, 0.25, -1],
      pushN: 52.5,
      spindleOn: true,
      irrigating: false,
      paused: true,
      held: false,
    } as const;
    const times = { sequence: 7, sentUs: 16666n, echoUs: 5n, echoAgeUs: 16000 };
    expect(decoded(encodeSteering(input, times))).toEqual(decoded(golden('device_steering')));
    const held = encodeSteering({ ...input, paused: false, held: true }, times);
    expect(decoded(held).buttons).toBe(Button.spindle | Button.deadman);
    const rinsing = encodeSteering({ ...input, paused: false, held: true, irrigating: true }, times);
    expect(decoded(rinsing).buttons).toBe(Button.spindle | Button.deadman | Button.irrigate);
    // Servers that do not look at the deadman of a Steering rest the session all the same.
    expect(decoded(encodeSteering({ ...input, paused: false }, times)).buttons & Button.pause).toBe(Button.pause);
  });

  it('greets as the schema has it', () => {
    const hello = read(encodeHello('page'), DeviceBody.DeviceHello, new DeviceHello());
    const other = read(golden('device_hello'), DeviceBody.DeviceHello, new DeviceHello());
    expect(hello.protocolRevision()).toBe(other.protocolRevision());
    expect(hello.name()).toBe('page');
  });

  it('reads Welcome and Feedback', () => {
    expect(decodeDeviceMessage(golden('device_welcome'))).toEqual({
      kind: 'welcome',
      welcome: { protocolRevision: 1, sessionId: 'k7m2', device: 'browser' },
    });
    expect(decodeDeviceMessage(golden('device_feedback'))).toEqual({
      kind: 'feedback',
      feedback: {
        sequence: 42,
        stampUs: 1234567890123n,
        tick: 61234,
        sentMs: null,
        link: 'fading',
        thrustN: 52.5,
        vibrationG: -0.75,
        engaged: true,
        rttMs: 1.5,
      },
    });
  });

  it('refuses what a server does not send', () => {
    expect(() => decodeDeviceMessage(golden('device_steering'))).toThrow();
    expect(() => decodeDeviceMessage(new Uint8Array(4))).toThrow();
  });
});
