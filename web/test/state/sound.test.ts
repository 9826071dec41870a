import { describe, expect, it } from 'vitest';

import { silence, type SoundParameters } from '../../src/sound/reaming_sound';
import { PracticeStore } from '../../src/state/practice_store';
import { Sound } from '../../src/state/sound';
import { Store } from '../../src/state/store';
import { hello, telemetry } from '../wire/fake_messages';

function cutting(store: Store, tick = 1): void {
  const message = telemetry({
    ...{ tick, spindleOn: true, densityGCc: 1.2, corticalShare: 1, feedRateMmS: 0.1 },
    thrustN: Float32Array.of(52),
  });
  if (message.kind === 'telemetry') store.telemetry.value = message.telemetry;
}

function place() {
  const store = new Store();
  const first = hello();
  if (first.kind === 'hello') store.hello.value = first.hello;
  store.link.value = { kind: 'live' };
  store.pictureComplete.value = true;
  store.sessionState.value = 'running';
  const sent: SoundParameters[] = [];
  let closed = 0;
  const sink = {
    setParameters: (parameters: SoundParameters) => void sent.push(parameters),
    close: () => void ++closed,
  };
  const sound = new Sound(store, new PracticeStore(store), () => Promise.resolve(sink));
  return { store, sound, sent, closed: () => closed };
}

describe('the sound of the reamer', () => {
  it('is off until it is asked for, and again afterwards', async () => {
    const { store, sound, sent, closed } = place();
    cutting(store);
    expect(sound.parameters.value).toEqual(silence);
    expect(sent).toEqual([]);
    await sound.toggle();
    cutting(store, 2);
    expect(sent.at(-1)?.cuttingGain).toBeGreaterThan(0);
    await sound.toggle();
    expect(closed()).toBe(1);
    const count = sent.length;
    cutting(store, 3);
    expect(sent).toHaveLength(count);
  });

  it('is told with every piece of news, so that it ends where there is none', async () => {
    const { store, sound, sent } = place();
    await sound.toggle();
    for (let tick = 1; tick <= 5; ++tick) cutting(store, tick);
    expect(sent.filter(({ cuttingGain }) => cuttingGain > 0)).toHaveLength(5);
  });

  it('is as strong as the reamer shakes', async () => {
    const { store, sound } = place();
    await sound.toggle();
    const gain = (...vibrationG: number[]) => {
      const message = telemetry({
        ...{ tick: 1, spindleOn: true, densityGCc: 1.2, corticalShare: 1, feedRateMmS: 0.1 },
        ...{ thrustN: Float32Array.of(52), vibrationG: Float32Array.from(vibrationG) },
      });
      if (message.kind === 'telemetry') store.telemetry.value = message.telemetry;
      return sound.parameters.value.cuttingGain;
    };
    expect(gain(0.1, -0.1)).toBeLessThan(gain(0.3, -0.3));
    expect(gain(0.3, -0.3)).toBeCloseTo(gain(), 6);
  });

  it('is silent as soon as what is shown is not of this moment', async () => {
    const { store, sound, sent } = place();
    await sound.toggle();
    cutting(store);
    expect(sent.at(-1)?.motorGain).toBeGreaterThan(0);
    store.link.value = { kind: 'silent', sinceMs: 0 };
    expect(sent.at(-1)).toEqual(silence);
    store.link.value = { kind: 'live' };
    store.sessionState.value = 'paused';
    expect(sent.at(-1)).toEqual(silence);
  });

  it('is heard in a recording only while it plays', async () => {
    const { store, sound, sent } = place();
    await sound.toggle();
    cutting(store);
    store.playback.value = { positionTicks: 1, speed: 1, playing: false, jump: 0 };
    expect(sent.at(-1)).toEqual(silence);
    store.playback.value = { positionTicks: 1, speed: 1, playing: true, jump: 0 };
    expect(sent.at(-1)?.cuttingGain).toBeGreaterThan(0);
  });

  it('says so where there is none to be had', async () => {
    const store = new Store();
    const sound = new Sound(store, new PracticeStore(store), () => Promise.reject(new Error('no device')));
    await sound.toggle();
    expect(sound.on.value).toBe(false);
    expect(sound.problem.value).toContain('no sound');
  });
});
