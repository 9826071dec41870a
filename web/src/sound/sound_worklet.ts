/** The browser's audio thread: makes the sound from the parameters that the page sends. */
import type { SoundMessage } from './reaming_sound';
import { Synthesizer } from './synthesizer';

// The names of an AudioWorkletGlobalScope are in no library of TypeScript's.
declare const sampleRate: number;
declare const registerProcessor: (name: string, processor: unknown) => void;
declare class AudioWorkletProcessor {
  readonly port: MessagePort;
}

class ReamingProcessor extends AudioWorkletProcessor {
  private readonly synthesizer = new Synthesizer(sampleRate);

  constructor() {
    super();
    this.port.onmessage = ({ data }: MessageEvent<SoundMessage>) => {
      if ('vibrationG' in data) this.synthesizer.addTrack(data.vibrationG);
      else this.synthesizer.setParameters(data);
    };
  }

  process(_inputs: unknown, outputs: Float32Array[][]): boolean {
    const [first, ...others] = outputs[0] ?? [];
    if (first === undefined) return true;
    this.synthesizer.render(first);
    for (const channel of others) channel.set(first);
    return true;
  }
}

registerProcessor('reaming', ReamingProcessor);
