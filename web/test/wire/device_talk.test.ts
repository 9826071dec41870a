import { ByteBuffer } from 'flatbuffers';
import { readFileSync } from 'node:fs';
import { beforeEach, describe, expect, it } from 'vitest';

import type { Wish } from '../../src/wire/device_messages';
import { DeviceTalk, wishGoodForMs } from '../../src/wire/device_talk';
import { Button, DeviceBody, DeviceMessage, Steering } from '../../src/wire/generated/device_generated';

const golden = (name: string) =>
  new Uint8Array(readFileSync(new URL(`../../../proto/golden/${name}.bin`, import.meta.url)));
const pushing: Wish = {
  sidewaysMm: [1, 2, 3],
  lean: [0, 0, 1],
  pushN: 40,
  spindleOn: true,
  paused: false,
  held: true,
};

describe('DeviceTalk', () => {
  const sent: Uint8Array[] = [];
  const socket = { bufferedAmount: 0, send: (bytes: Uint8Array) => void sent.push(bytes) };
  let nowMs: number;
  let talk: DeviceTalk;
  beforeEach(() => {
    sent.length = 0;
    socket.bufferedAmount = 0;
    nowMs = 1000;
    talk = new DeviceTalk(socket, () => nowMs);
  });
  const newest = () => {
    const message = DeviceMessage.getRootAsDeviceMessage(new ByteBuffer(sent.at(-1) ?? new Uint8Array()));
    expect(message.bodyType()).toBe(DeviceBody.Steering);
    return message.body(new Steering()) as Steering;
  };

  it('greets first and steers only once it is welcome and there is a wish', () => {
    talk.greet();
    talk.setWish(pushing);
    talk.beat();
    expect(sent).toHaveLength(1);
    talk.hear(golden('device_welcome'));
    talk.beat();
    expect(newest().pushN()).toBe(40);
    expect(newest().sequence()).toBe(1);
    expect(newest().echoUs()).toBe(0n);
    expect(newest().echoAgeUs()).toBe(0);
  });

  it('says the newest wish at every beat, numbered, with the newest stamp and its age', () => {
    talk.hear(golden('device_welcome'));
    talk.setWish({ ...pushing, pushN: 10 });
    talk.setWish(pushing);
    talk.hear(golden('device_feedback'));
    nowMs += 12;
    talk.beat();
    talk.beat();
    expect(sent).toHaveLength(2);
    expect(newest().sequence()).toBe(2);
    expect(newest().pushN()).toBe(40);
    expect(newest().echoUs()).toBe(1234567890123n);
    expect(newest().echoAgeUs()).toBe(12_000);
  });

  it('tells when the wish that the server has taken was sent', () => {
    const feedback = golden('device_feedback');
    const sentMs = () => {
      const report = talk.hear(feedback);
      return report.kind === 'feedback' ? report.feedback : null;
    };
    expect(sentMs()?.sentMs).toBeNull();
    talk = new DeviceTalk(socket, () => nowMs, 50_000);
    talk.hear(golden('device_welcome'));
    talk.setWish(pushing);
    const taken = sentMs()?.sequence ?? 0;
    for (let i = 0; i < taken + 3; ++i) {
      nowMs = 1000 + i;
      talk.beat();
    }
    expect(sentMs()?.sentMs).toBe(50_000 + 1000 + taken - 1);
    for (let i = 0; i < 500; ++i) talk.beat();
    expect(sentMs()?.sentMs).toBeNull();
  });

  it('takes the push away without waiting for the next beat', () => {
    talk.hear(golden('device_welcome'));
    talk.setWish(pushing);
    expect(sent).toHaveLength(0);
    talk.setWish({ ...pushing, pushN: 0 });
    expect(newest().pushN()).toBe(0);
    talk.setWish({ ...pushing, pushN: 0 });
    expect(sent).toHaveLength(1);
    talk.setWish({ ...pushing, pushN: 0, held: false });
    expect(sent).toHaveLength(2);
  });

  it('passes on no push of a page that is stuck', () => {
    talk.hear(golden('device_welcome'));
    talk.setWish(pushing);
    nowMs += wishGoodForMs - 1;
    talk.beat();
    expect(newest().pushN()).toBe(40);
    nowMs += 2;
    talk.beat();
    expect(newest().pushN()).toBe(0);
    expect(newest().buttons()).toBe(Button.pause);
    talk.setWish(pushing);
    talk.beat();
    expect(newest().pushN()).toBe(40);
  });

  it('does not queue up behind a link that is stuck', () => {
    talk.hear(golden('device_welcome'));
    talk.setWish(pushing);
    socket.bufferedAmount = 100_000;
    for (let i = 0; i < 50; ++i) talk.beat();
    expect(sent).toHaveLength(0);
    socket.bufferedAmount = 0;
    talk.beat();
    expect(sent).toHaveLength(1);
  });
});
