import type { VoxelAxis } from '../wire/case_api';

export interface SliceKey {
  of: 'hu' | 'labels';
  revision: number;
  axis: VoxelAxis;
  index: number;
}

export type FetchSlice = (key: SliceKey, signal: AbortSignal) => Promise<ArrayBuffer>;

const nameOf = ({ of, revision, axis, index }: SliceKey) => `${of}/${revision}/${axis}/${index}`;

interface Waiting {
  promise: Promise<ArrayBuffer>;
  abort: AbortController;
}

/**
 * Slices as the server has them, the most recently used kept up to a number of bytes. One slice is fetched once at a
 * time however many ask; what failed is forgotten, so that it is asked for again.
 */
export class SliceCache {
  /** In order of use, oldest first. */
  private readonly kept = new Map<string, ArrayBuffer>();
  private readonly waiting = new Map<string, Waiting>();
  private keptBytes = 0;

  constructor(
    private readonly fetchSlice: FetchSlice,
    private readonly maxBytes = 192 << 20,
    private readonly maxPrefetches = 4,
  ) {}

  get bytes(): number {
    return this.keptBytes;
  }

  /** The slice if it is here; counts as use. */
  peek(key: SliceKey): ArrayBuffer | null {
    const name = nameOf(key);
    const found = this.kept.get(name);
    if (found === undefined) return null;
    this.kept.delete(name);
    this.kept.set(name, found);
    return found;
  }

  get(key: SliceKey): Promise<ArrayBuffer> {
    const found = this.peek(key);
    if (found !== null) return Promise.resolve(found);
    const name = nameOf(key);
    const underWay = this.waiting.get(name);
    if (underWay !== undefined) return underWay.promise;
    const abort = new AbortController();
    const promise = this.fetchSlice(key, abort.signal).then(
      (bytes) => {
        if (this.waiting.get(name)?.abort === abort) {
          this.waiting.delete(name);
          this.keep(name, bytes);
        }
        return bytes;
      },
      (error: unknown) => {
        if (this.waiting.get(name)?.abort === abort) this.waiting.delete(name);
        throw error;
      },
    );
    this.waiting.set(name, { promise, abort });
    return promise;
  }

  /** Fetches what is likely wanted next, unless enough is under way. */
  prefetch(keys: readonly SliceKey[]): void {
    for (const key of keys) {
      if (this.waiting.size >= this.maxPrefetches) return;
      if (!this.kept.has(nameOf(key))) this.get(key).catch(() => undefined);
    }
  }

  /** Gives up what is under way and forgets everything. */
  clear(): void {
    for (const { abort } of this.waiting.values()) abort.abort();
    this.waiting.clear();
    this.kept.clear();
    this.keptBytes = 0;
  }

  private keep(name: string, bytes: ArrayBuffer): void {
    this.kept.set(name, bytes);
    this.keptBytes += bytes.byteLength;
    for (const [oldest, old] of this.kept) {
      if (this.keptBytes <= this.maxBytes || oldest === name) break;
      this.kept.delete(oldest);
      this.keptBytes -= old.byteLength;
    }
  }
}
