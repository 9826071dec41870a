import { effect, signal } from '@preact/signals';

import { liveText } from '../text/live_text';
import { silence, type SoundParameters, soundOf } from '../sound/reaming_sound';
import type { Telemetry } from '../wire/telemetry';
import type { Store } from './store';

/** Where sound goes. */
export interface SoundSink {
  setParameters(parameters: SoundParameters): void;
  /** Vibration of the next ticks, g. */
  addTrack(vibrationG: Float32Array): void;
  close(): void;
}

/** The sound of the reamer, when it is wanted: of this moment only. */
export class Sound {
  readonly on = signal(false);
  /** Words of why there is no sound. */
  readonly problem = signal<string | null>(null);
  /** The newest parameters; for tests and the readout. */
  readonly parameters = signal<SoundParameters>(silence);
  private sink: SoundSink | null = null;
  /** The newest batch: the vibration of each is heard once. */
  private heard: Telemetry | null = null;

  constructor(
    private readonly store: Store,
    private readonly open: () => Promise<SoundSink>,
  ) {
    effect(() => {
      const parameters = this.now();
      this.parameters.value = parameters;
      this.sink?.setParameters(parameters);
      this.sendTrack(parameters.trackGain > 0);
    });
  }

  /** To be called from a click or a key. */
  async toggle(): Promise<void> {
    this.problem.value = null;
    this.on.value = !this.on.value;
    if (!this.on.value) return this.close();
    try {
      const sink = await this.open();
      if (this.on.peek() && this.sink === null) this.sink = sink;
      else sink.close();
    } catch {
      this.on.value = false;
      this.problem.value = liveText.noSound;
    }
  }

  private close(): void {
    this.sink?.close();
    this.sink = null;
  }

  private now(): SoundParameters {
    const { store } = this;
    // Every batch updates the sound, also one equal to the last: when telemetry stops, so does the sound.
    const t = store.telemetry.value;
    if (!this.on.value || t === null || !store.upToDate.value) return silence;
    const moves = store.playback.value === null ? store.sessionState.value === 'running' : store.playback.value.playing;
    if (!moves) return silence;
    // What came before a jump of a replay is drawn, not heard.
    if (t.tickStride !== 1) return this.parameters.peek();
    const { vibrationG, spindleOn, stalled } = t;
    const tracked = vibrationG.length > 0 && (store.playback.value?.speed ?? 1) === 1;
    const saysSpeed = store.playback.value === null || t.spindleSpeedRadS !== 0 || !spindleOn || stalled;
    const spindleSpeedRadS = saysSpeed ? t.spindleSpeedRadS : null;
    const thrustN = t.thrustN.at(-1) ?? 0;
    return soundOf({ ...t, thrustN, spindleSpeedRadS, vibrationG: rootMeanSquare(vibrationG), tracked });
  }

  private sendTrack(tracked: boolean): void {
    const t = this.store.telemetry.peek();
    if (t === null || t === this.heard) return;
    this.heard = t;
    if (tracked && t.tickStride === 1) this.sink?.addTrack(t.vibrationG);
  }
}

/** Null of nothing: then the sound is that which is usual for the bone. */
function rootMeanSquare(values: Float32Array): number | null {
  if (values.length === 0) return null;
  return Math.sqrt(values.reduce((sum, value) => sum + value * value, 0) / values.length);
}
