import { effect, signal } from '@preact/signals';

import { liveText } from '../text/live_text';
import { type Heard, silence, type SoundParameters, soundOf } from '../sound/reaming_sound';
import type { PracticeStore } from './practice_store';
import type { Store } from './store';

/** Where sound goes. */
export interface SoundSink {
  tell(parameters: SoundParameters): void;
  close(): void;
}

/** The sound of the reamer, when it is wanted: of this moment only. */
export class Sound {
  readonly on = signal(false);
  /** Words of why there is no sound. */
  readonly problem = signal<string | null>(null);
  /** What was told last; for who looks at it. */
  readonly told = signal<SoundParameters>(silence);
  private sink: SoundSink | null = null;

  constructor(
    private readonly store: Store,
    private readonly practice: PracticeStore,
    private readonly open: () => Promise<SoundSink>,
  ) {
    effect(() => {
      const parameters = this.now();
      this.told.value = parameters;
      this.sink?.tell(parameters);
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
    const { store, practice } = this;
    // Each batch is told, also one that is as the one before: news that stops lets the sound stop.
    const t = store.telemetry.value;
    if (!this.on.value || t === null || !store.upToDate.value) return silence;
    const moves = store.playback.value === null ? store.sessionState.value === 'running' : store.playback.value.playing;
    if (!moves) return silence;
    const steered = practice.steering.value ? practice.feedback.peek() : null;
    const heard: Heard = { ...t, thrustN: t.thrustN.at(-1) ?? 0, vibrationG: rootMeanSquare(t.vibrationG) };
    // The hand's is of one moment and of either sign: it may only add.
    const told = soundOf(heard);
    if (steered === null) return told;
    const felt = soundOf({ ...heard, vibrationG: steered.vibrationG });
    return { ...told, cuttingGain: Math.max(told.cuttingGain, felt.cuttingGain) };
  }
}

/** Null of nothing: then the sound is that which is usual for the bone. */
function rootMeanSquare(values: Float32Array): number | null {
  if (values.length === 0) return null;
  return Math.sqrt(values.reduce((sum, value) => sum + value * value, 0) / values.length);
}
