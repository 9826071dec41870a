import { silence, type SoundParameters } from './reaming_sound';
import { TrackPlayer } from './track_player';

/** Without an update for so long it is silent: the last parameters are out of date. */
export const silentAfterS = 0.3;
/** Gains and pitches reach their targets after about this time, so that nothing clicks. */
const smoothS = 0.025;
/** The band of the cutting noise is this part of its middle wide. */
const bandShare = 0.9;
/** Vibration comes once a tick, Hz. */
export const trackHz = 1000;
/** Teeth of the reamer pass the bone so many times a turn of the hum, which makes the noise rough. */
const roughHzShare = 0.25;

/** Makes the sound of the reamer sample by sample. The same calls give the same samples. */
export class Synthesizer {
  private target: SoundParameters = silence;
  private now: SoundParameters = { ...silence };
  private sinceUpdateS = Infinity;
  private motorTurns = 0;
  private roughTurns = 0;
  private noise = 0x2545f491;
  private low = 0;
  private band = 0;

  private readonly track: TrackPlayer;

  constructor(private readonly sampleRate: number) {
    this.track = new TrackPlayer(trackHz, sampleRate);
  }

  /** Vibration of the next ticks, g. */
  addTrack(vibrationG: Float32Array): void {
    this.track.add(vibrationG);
  }

  /** What is heard from here on, as long as updates follow. */
  setParameters(parameters: SoundParameters): void {
    this.target = parameters;
    this.sinceUpdateS = 0;
  }

  /** Fills the next samples, each within -1 and 1. */
  render(out: Float32Array): void {
    const stepS = 1 / this.sampleRate;
    const goal =
      this.sinceUpdateS > silentAfterS ? { ...this.target, motorGain: 0, cuttingGain: 0, trackGain: 0 } : this.target;
    const towards = 1 - Math.exp(-stepS / smoothS);
    for (let i = 0; i < out.length; ++i) {
      this.approach(goal, towards);
      out[i] = Math.tanh(this.motor(stepS) + this.cutting(stepS) + this.now.trackGain * this.track.next());
    }
    this.sinceUpdateS += out.length * stepS;
  }

  private approach(goal: SoundParameters, share: number): void {
    const { now } = this;
    // From silence it begins at its pitch: only what is heard glides.
    const pitch = now.motorGain + now.cuttingGain + now.trackGain < 1e-4 ? 1 : share;
    now.motorHz += (goal.motorHz - now.motorHz) * (goal.motorHz > 0 ? pitch : 0);
    now.cuttingHz += (goal.cuttingHz - now.cuttingHz) * (goal.cuttingHz > 0 ? pitch : 0);
    now.motorGain += (goal.motorGain - now.motorGain) * share;
    now.cuttingGain += (goal.cuttingGain - now.cuttingGain) * share;
    now.trackGain += (goal.trackGain - now.trackGain) * share;
  }

  /** A hum with overtones. */
  private motor(stepS: number): number {
    this.motorTurns = (this.motorTurns + this.now.motorHz * stepS) % 1;
    const angle = this.motorTurns * 2 * Math.PI;
    const wave = Math.sin(angle) + 0.5 * Math.sin(2 * angle) + 0.3 * Math.sin(3 * angle) + 0.16 * Math.sin(5 * angle);
    return (wave / 1.6) * this.now.motorGain;
  }

  /** Noise through a band (state variable filter), rough by the passing teeth. */
  private cutting(stepS: number): number {
    const { cuttingHz, motorHz, cuttingGain } = this.now;
    const f = 2 * Math.sin(Math.PI * Math.min(cuttingHz * stepS, 1 / 6));
    const high = this.whiteNoise() - this.low - bandShare * this.band;
    this.band += f * high;
    this.low += f * this.band;
    this.roughTurns = (this.roughTurns + motorHz * roughHzShare * stepS) % 1;
    const rough = 0.65 + 0.35 * Math.sin(this.roughTurns * 2 * Math.PI);
    return this.band * rough * cuttingGain;
  }

  /** Xorshift (Marsaglia 2003), -1 to 1. */
  private whiteNoise(): number {
    let x = this.noise;
    x ^= x << 13;
    x ^= x >>> 17;
    x ^= x << 5;
    this.noise = x;
    return x / 0x80000000;
  }
}
