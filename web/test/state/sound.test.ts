import { describe, expect, it } from 'vitest';

import { silence, type SoundParameters } from '../../src/sound/reaming_sound';
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
  const tracks: Float32Array[] = [];
  let closed = 0;
  const sink = {
    setParameters: (parameters: SoundParameters) => void sent.push(parameters),
    addTrack: (vibrationG: Float32Array) => void tracks.push(vibrationG),
    close: () => void ++closed,
  };
  const sound = new Sound(store, () => Promise.resolve(sink));
  return { store, sound, sent, tracks, closed: () => closed };
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

  it('is the vibration that is sent, each batch once', async () => {
    const { store, sound, sent, tracks } = place();
    await sound.toggle();
    const send = (tick: number, tickStride: number, ...vibrationG: number[]) => {
      const message = telemetry({
        ...{ tick, tickStride, spindleOn: true, densityGCc: 1.2, corticalShare: 1, feedRateMmS: 0.1 },
        ...{ thrustN: Float32Array.of(52), vibrationG: Float32Array.from(vibrationG) },
      });
      if (message.kind === 'telemetry') store.telemetry.value = message.telemetry;
    };
    send(2, 1, 0.25, -0.5);
    expect(sent.at(-1)).toMatchObject({ cuttingGain: 0 });
    expect(sent.at(-1)?.trackGain).toBeGreaterThan(0);
    store.playback.value = { positionTicks: 1, speed: 1, playing: true, jump: 0 };
    send(3, 1, 1);
    expect(tracks.map((track) => [...track])).toEqual([[0.25, -0.5], [1]]);
    // At another speed it cannot be played as it is.
    store.playback.value = { positionTicks: 1, speed: 2, playing: true, jump: 0 };
    send(4, 1, 1);
    expect(tracks).toHaveLength(2);
    expect(sent.at(-1)).toMatchObject({ trackGain: 0 });
    expect(sent.at(-1)?.cuttingGain).toBeGreaterThan(0);
    // What came before a jump is not heard.
    store.playback.value = { positionTicks: 1, speed: 1, playing: true, jump: 1 };
    send(5, 10, 1);
    expect(tracks).toHaveLength(2);
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
    const sound = new Sound(store, () => Promise.reject(new Error('no device')));
    await sound.toggle();
    expect(sound.on.value).toBe(false);
    expect(sound.problem.value).toContain('cannot play');
  });
});
