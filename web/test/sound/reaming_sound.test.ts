import { describe, expect, it } from 'vitest';

import { type SoundInput, silence, soundOf } from '../../src/sound/reaming_sound';
import { silentAfterS, Synthesizer } from '../../src/sound/synthesizer';

const rate = 48000;
const block = 128;
const seated: SoundInput = {
  spindleOn: true,
  thrustN: 52,
  feedRateMmS: 0.2,
  densityGCc: 1.4,
  corticalShare: 1,
  spindleSpeedRadS: null,
  stalled: false,
  vibrationG: null,
  tracked: false,
};

function rendered(synthesizer: Synthesizer, seconds: number): Float32Array {
  const out = new Float32Array(Math.ceil((seconds * rate) / block) * block);
  for (let at = 0; at < out.length; at += block) synthesizer.render(out.subarray(at, at + block));
  return out;
}
const rms = (samples: Float32Array) => Math.sqrt(samples.reduce((sum, x) => sum + x * x, 0) / samples.length);
/** Crossings of zero a second: grows with the pitch of a noise. */
const crossings = (samples: Float32Array) =>
  samples.reduce((count, x, i) => count + (i > 0 && x >= 0 !== (samples[i - 1] ?? 0) >= 0 ? 1 : 0), 0) /
  (samples.length / rate);

/** What it sounds like after it has settled. */
function sound(heard: SoundInput): Float32Array {
  const synthesizer = new Synthesizer(rate);
  synthesizer.setParameters(soundOf(heard));
  rendered(synthesizer, 0.1);
  synthesizer.setParameters(soundOf(heard));
  return rendered(synthesizer, 0.2);
}

describe('what the reamer sounds like', () => {
  it('keeps the published strength within bounds, blow by blow', () => {
    const { trackGain } = soundOf({ ...seated, tracked: true });
    expect(Math.tanh(2.6 * trackGain)).toBeLessThan(0.8);
    expect(trackGain * 0.3).toBeGreaterThan(0.1);
  });

  it('is nothing while the spindle stands, whatever else is told', () => {
    expect(soundOf({ ...seated, spindleOn: false })).toEqual(silence);
    expect(rms(sound({ ...seated, spindleOn: false }))).toBe(0);
  });

  it('is a hum alone in the air', () => {
    const air = soundOf({ ...seated, thrustN: 0, densityGCc: 0 });
    expect(air.cuttingGain).toBe(0);
    expect(air.motorGain).toBeGreaterThan(0);
  });

  it('is slower and louder the harder the push', () => {
    const soft = soundOf({ ...seated, thrustN: 20 });
    const hard = soundOf({ ...seated, thrustN: 60 });
    expect(hard.motorHz).toBeLessThan(soft.motorHz);
    expect(hard.cuttingGain).toBeGreaterThan(soft.cuttingGain);
    expect(rms(sound({ ...seated, thrustN: 60 }))).toBeGreaterThan(rms(sound({ ...seated, thrustN: 10 })));
  });

  it('is brighter in cortical and stronger in cancellous bone, as it was measured', () => {
    const cancellous = { ...seated, corticalShare: 0 };
    expect(soundOf(seated).cuttingHz).toBeGreaterThan(2 * soundOf(cancellous).cuttingHz);
    expect(soundOf(cancellous).cuttingGain / soundOf(seated).cuttingGain).toBeCloseTo(0.4 / 0.3, 6);
    expect(crossings(sound(seated))).toBeGreaterThan(1.5 * crossings(sound(cancellous)));
  });

  it('rubs more quietly where the reamer does not go in', () => {
    expect(soundOf({ ...seated, feedRateMmS: 0 }).cuttingGain).toBeLessThan(soundOf(seated).cuttingGain);
  });

  it('hums as fast as the spindle turns, either way around', () => {
    const at = (rpm: number) => soundOf({ ...seated, spindleSpeedRadS: (rpm * 2 * Math.PI) / 60 }).motorHz;
    expect(at(156)).toBeCloseTo(190, 6);
    expect(at(-78)).toBeCloseTo(95, 6);
    expect(soundOf({ ...seated, spindleSpeedRadS: 0, stalled: true }).motorHz).toBeLessThan(at(78));
    const coasting = soundOf({ ...seated, spindleOn: false, spindleSpeedRadS: 8 });
    expect(coasting.motorGain).toBeGreaterThan(0);
    expect(coasting.motorGain).toBeLessThan(soundOf({ ...seated, spindleSpeedRadS: 16.3 }).motorGain);
    expect(soundOf({ ...seated, spindleSpeedRadS: 0.1 })).toEqual(silence);
  });

  it('goes by the vibration where that is told', () => {
    const weak = soundOf({ ...seated, vibrationG: 0.05 });
    const strong = soundOf({ ...seated, vibrationG: 0.4 });
    expect(strong.cuttingGain / weak.cuttingGain).toBeCloseTo(8, 6);
  });

  it('stays within bounds, also for nonsense', () => {
    for (const odd of [NaN, Infinity, -1e9, 1e9]) {
      const found = soundOf({ ...seated, thrustN: odd, corticalShare: odd, feedRateMmS: odd, vibrationG: odd });
      for (const value of [found.motorHz, found.motorGain, found.cuttingHz]) expect(Number.isFinite(value)).toBe(true);
    }
    const loud = sound({ ...seated, vibrationG: 50, thrustN: 1e6 });
    expect(Math.max(...loud.map(Math.abs))).toBeLessThanOrEqual(1);
  });
});

describe('the synthesizer', () => {
  it('gives the same samples for the same calls', () => {
    expect(sound(seated)).toEqual(sound(seated));
  });

  it('falls silent when there is no more news, and comes back with it', () => {
    const synthesizer = new Synthesizer(rate);
    synthesizer.setParameters(soundOf(seated));
    expect(rms(rendered(synthesizer, silentAfterS * 0.9))).toBeGreaterThan(0.02);
    rendered(synthesizer, 0.5);
    expect(rms(rendered(synthesizer, 0.2))).toBeLessThan(1e-4);
    synthesizer.setParameters(soundOf(seated));
    rendered(synthesizer, 0.1);
    expect(rms(rendered(synthesizer, 0.1))).toBeGreaterThan(0.02);
  });

  it('does not click: it begins and ends gradually', () => {
    const synthesizer = new Synthesizer(rate);
    synthesizer.setParameters(soundOf({ ...seated, densityGCc: 0 }));
    const begins = rendered(synthesizer, 0.01);
    const steepest = begins.reduce((most, x, i) => Math.max(most, Math.abs(x - (begins[i - 1] ?? 0))), 0);
    expect(steepest).toBeLessThan(0.03);
  });
});
