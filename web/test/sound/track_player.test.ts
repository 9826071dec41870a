import { describe, expect, it } from 'vitest';

import { soundOf } from '../../src/sound/reaming_sound';
import { Synthesizer, trackHz } from '../../src/sound/synthesizer';
import { TrackPlayer } from '../../src/sound/track_player';

const rate = 48000;
const perTick = rate / trackHz;

/** Noise below 400 Hz, as a hand feels it: g at ticks. */
function vibration(ticks: number): Float32Array {
  const waves = Array.from({ length: 40 }, (_, i) => ({ hz: 10 * i + 7, phase: (i * i * 1.7) % 6.28 }));
  return Float32Array.from({ length: ticks }, (_, t) =>
    waves.reduce((sum, { hz, phase }) => sum + 0.05 * Math.sin((2 * Math.PI * hz * t) / trackHz + phase), 0),
  );
}

/** Heard while batches of that many ticks come in, each when its last tick has passed. */
function played(track: Float32Array, batchTicks: number, player = new TrackPlayer(trackHz, rate)): Float32Array {
  const heard = new Float32Array(track.length * perTick);
  for (let i = 0; i < heard.length; ++i) {
    if (i % (batchTicks * perTick) === 0 && i > 0) player.add(track.subarray(i / perTick - batchTicks, i / perTick));
    heard[i] = player.next();
  }
  return heard;
}

/** Largest correlation of the two over all delays up to a quarter of a second, and that delay, s. */
function likeness(track: Float32Array, heard: Float32Array, fromTick: number, toTick: number) {
  let best = { correlation: 0, delayS: 0 };
  for (let delay = 0; delay < rate / 4; delay += 4) {
    let product = 0;
    let a2 = 0;
    let b2 = 0;
    for (let t = fromTick; t < toTick; ++t) {
      const a = track[t] ?? 0;
      const b = heard[t * perTick + delay] ?? 0;
      product += a * b;
      a2 += a * a;
      b2 += b * b;
    }
    const correlation = product / Math.sqrt(a2 * b2);
    if (correlation > best.correlation) best = { correlation, delayS: delay / rate };
  }
  return best;
}

describe('a track that is sent', () => {
  it('is heard as the hand feels it, at most a tenth of a second later', () => {
    const track = vibration(3000);
    for (const batch of [16, 33, 50]) {
      const { correlation, delayS } = likeness(track, played(track, batch), 1000, 1300);
      expect(correlation).toBeGreaterThan(0.95);
      expect(delayS).toBeLessThan(0.11);
    }
  });

  it('goes through the synthesizer', () => {
    const synthesizer = new Synthesizer(rate);
    const track = vibration(1500).map((g) => 0.3 * g);
    const parameters = { ...soundOf({ ...silentDrive, tracked: true }), motorGain: 0 };
    const heard = new Float32Array(track.length * perTick);
    for (let t = 0; t < track.length; t += 20) {
      synthesizer.setParameters(parameters);
      synthesizer.addTrack(track.subarray(t, t + 20));
      synthesizer.render(heard.subarray(t * perTick, (t + 20) * perTick));
    }
    expect(likeness(track, heard, 600, 900).correlation).toBeGreaterThan(0.9);
  });

  it('keeps up when more comes than is heard, and is still when nothing comes', () => {
    const player = new TrackPlayer(trackHz, rate);
    const track = vibration(2000);
    for (let t = 0; t < 2000; t += 500) player.add(track.subarray(t, t + 500));
    let heard = 0;
    for (let i = 0; i < 0.3 * rate; ++i) heard += Math.abs(player.next());
    expect(heard).toBeGreaterThan(1);
    for (let i = 0; i < 100; ++i) expect(player.next()).toBeCloseTo(0, 12);
  });

  it('makes no click where it begins and ends', () => {
    const heard = played(Float32Array.from({ length: 400 }, (_, t) => (t < 200 ? 1 : 0)).subarray(0, 200), 20);
    const steepest = heard.reduce((most, x, i) => Math.max(most, Math.abs(x - (heard[i - 1] ?? 0))), 0);
    expect(Math.max(...heard)).toBeCloseTo(1, 2);
    expect(steepest).toBeLessThan(0.02);
  });

  it('is nothing of what is no number', () => {
    const player = new TrackPlayer(trackHz, rate);
    player.add(Float32Array.from({ length: 200 }, () => NaN));
    for (let i = 0; i < 5000; ++i) expect(Number.isFinite(player.next())).toBe(true);
  });
});

const silentDrive = {
  spindleOn: true,
  thrustN: 0,
  feedRateMmS: 0,
  densityGCc: 0,
  corticalShare: 0,
  spindleSpeedRadS: 16.3,
  stalled: false,
  vibrationG: null,
};
