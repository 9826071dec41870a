/** What the twin's WebAssembly exports (server/twin/wasm/exports.cpp); addresses are of its memory. */
interface TwinExports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  twin_input(bytes: number): number;
  twin_take(): number;
  twin_agreed_ticks(): number;
  twin_ended(): number;
  twin_recorded_ticks(): number;
}

const outcomes = ['agrees', 'damaged', 'differs'] as const;
/** Of the parts taken so far: they agree, cannot be read, or another bone comes of them. */
export type Outcome = (typeof outcomes)[number];

/**
 * A session's bone, computed again here from its causes by the program's own sources. One session a module. Throws
 * WebAssembly.RuntimeError where memory runs out; nothing is to be asked of it then.
 */
export class TwinModule {
  private constructor(private readonly twin: TwinExports) {
    twin._initialize();
  }

  static async load(module: ArrayBuffer): Promise<TwinModule> {
    const { instance } = await WebAssembly.instantiate(module);
    return new TwinModule(instance.exports as unknown as TwinExports);
  }

  take(part: Uint8Array): Outcome {
    const place = this.twin.twin_input(part.length) >>> 0;
    // Memory may have grown, and its buffer with it.
    new Uint8Array(this.twin.memory.buffer, place, part.length).set(part);
    return outcomes[this.twin.twin_take()] ?? 'damaged';
  }

  /** Ticks whose hashes agreed. */
  get agreedTicks(): number {
    return this.twin.twin_agreed_ticks();
  }

  /** Of the whole recording: more than agreed where its last ticks have no bone. Null before the end was taken. */
  get recordedTicks(): number | null {
    return this.twin.twin_ended() === 1 ? this.twin.twin_recorded_ticks() : null;
  }
}
