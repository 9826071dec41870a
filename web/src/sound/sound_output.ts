import type { SoundMessage, SoundParameters } from './reaming_sound';
import workletUrl from './sound_worklet?worker&url';

/** Sound from the loudspeaker, made on the browser's audio thread. */
export class SoundOutput {
  private constructor(
    private readonly context: AudioContext,
    private readonly node: AudioWorkletNode,
  ) {}

  /** Only after a click or key: browsers keep silent otherwise. Throws where there is no sound to be had. */
  static async open(): Promise<SoundOutput> {
    const context = new AudioContext({ latencyHint: 'interactive' });
    try {
      await context.audioWorklet.addModule(workletUrl);
      const node = new AudioWorkletNode(context, 'reaming', { numberOfInputs: 0, outputChannelCount: [1] });
      node.connect(context.destination);
      await context.resume();
      return new SoundOutput(context, node);
    } catch (error) {
      await context.close();
      throw error;
    }
  }

  setParameters(parameters: SoundParameters): void {
    this.post(parameters);
  }

  addTrack(vibrationG: Float32Array): void {
    this.post({ vibrationG });
  }

  private post(message: SoundMessage): void {
    this.node.port.postMessage(message);
  }

  close(): void {
    this.node.disconnect();
    void this.context.close();
  }
}
