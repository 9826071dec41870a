import { ByteBuffer } from 'flatbuffers';
import { readFileSync } from 'node:fs';
import { beforeEach, describe, expect, it } from 'vitest';

import type { SteeringInput } from '../../src/wire/device_messages';
import { DeviceProtocol, inputValidForMs } from '../../src/wire/device_protocol';
import { Button, DeviceBody, DeviceMessage, Steering } from '../../src/wire/generated/device_generated';

const golden = (name: string) =>
  new Uint8Array(readFileSync(new URL(`../../../proto/golden/${name}.bin`, import.meta.url)));
const pushing: SteeringInput = {
  sidewaysMm: [1, 2, 3],
  lean: [0, 0, 1],
  pushN: 40,
  spindleOn: true,
  irrigating: false,
  paused: false,
  held: true,
};

describe('DeviceTalk', () => {
  const sent: Uint8Array[] = [];
  const socket = { bufferedAmount: 0, send: (bytes: Uint8Array) => void sent.push(bytes) };
  let nowMs: number;
  let protocol: DeviceProtocol;
  beforeEach(() => {
    sent.length = 0;
    socket.bufferedAmount = 0;
    nowMs = 1000;
    protocol = new DeviceProtocol(socket, () => nowMs);
  });
  const newest = () => {
    const message = DeviceMessage.getRootAsDeviceMessage(new ByteBuffer(sent.at(-1) ?? new Uint8Array()));
    expect(message.bodyType()).toBe(DeviceBody.Steering);
    return message.body(new Steering()) as Steering;
  };

  it('greets first and steers only once it is welcome and there is an input', () => {
    protocol.greet();
    protocol.setInput(pushing);
    protocol.beat();
    expect(sent).toHaveLength(1);
    protocol.receive(golden('device_welcome'));
    protocol.beat();
    expect(newest().pushN()).toBe(40);
    expect(newest().sequence()).toBe(1);
    expect(newest().echoUs()).toBe(0n);
    expect(newest().echoAgeUs()).toBe(0);
  });

  it('sends the newest input at every beat, numbered, with the newest stamp and its age', () => {
    protocol.receive(golden('device_welcome'));
    protocol.setInput({ ...pushing, pushN: 10 });
    protocol.setInput(pushing);
    protocol.receive(golden('device_feedback'));
    nowMs += 12;
    protocol.beat();
    protocol.beat();
    expect(sent).toHaveLength(2);
    expect(newest().sequence()).toBe(2);
    expect(newest().pushN()).toBe(40);
    expect(newest().echoUs()).toBe(1234567890123n);
    expect(newest().echoAgeUs()).toBe(12_000);
  });

  it('reports when the input that the server has taken was sent', () => {
    const feedback = golden('device_feedback');
    const sentMs = () => {
      const report = protocol.receive(feedback);
      return report.kind === 'feedback' ? report.feedback : null;
    };
    expect(sentMs()?.sentMs).toBeNull();
    protocol = new DeviceProtocol(socket, () => nowMs, 50_000);
    protocol.receive(golden('device_welcome'));
    protocol.setInput(pushing);
    const taken = sentMs()?.sequence ?? 0;
    for (let i = 0; i < taken + 3; ++i) {
      nowMs = 1000 + i;
      protocol.beat();
    }
    expect(sentMs()?.sentMs).toBe(50_000 + 1000 + taken - 1);
    for (let i = 0; i < 500; ++i) protocol.beat();
    expect(sentMs()?.sentMs).toBeNull();
  });

  it('takes the push away without waiting for the next beat', () => {
    protocol.receive(golden('device_welcome'));
    protocol.setInput(pushing);
    expect(sent).toHaveLength(0);
    protocol.setInput({ ...pushing, pushN: 0 });
    expect(newest().pushN()).toBe(0);
    protocol.setInput({ ...pushing, pushN: 0 });
    expect(sent).toHaveLength(1);
    protocol.setInput({ ...pushing, pushN: 0, held: false });
    expect(sent).toHaveLength(2);
  });

  it('passes on no push of a page that is stuck', () => {
    protocol.receive(golden('device_welcome'));
    protocol.setInput(pushing);
    nowMs += inputValidForMs - 1;
    protocol.beat();
    expect(newest().pushN()).toBe(40);
    nowMs += 2;
    protocol.beat();
    expect(newest().pushN()).toBe(0);
    expect(newest().buttons()).toBe(Button.pause);
    protocol.setInput(pushing);
    protocol.beat();
    expect(newest().pushN()).toBe(40);
  });

  it('does not queue up behind a link that is stuck', () => {
    protocol.receive(golden('device_welcome'));
    protocol.setInput(pushing);
    socket.bufferedAmount = 100_000;
    for (let i = 0; i < 50; ++i) protocol.beat();
    expect(sent).toHaveLength(0);
    socket.bufferedAmount = 0;
    protocol.beat();
    expect(sent).toHaveLength(1);
  });
});
