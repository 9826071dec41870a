import { batch, signal } from '@preact/signals';

import { ApiError, messageOf } from '../../wire/rest';
import type { DeviationBytes, MapName } from '../../wire/review_api';
import type { SortedSurface } from '../../wire/sorted_surface';
import { reviewText } from '../../text/review_text';
import { mapErrorMessage } from './session_error';

export type MapState =
  | { kind: 'none' }
  | { kind: 'making'; name: MapName; share: number }
  | { kind: 'ready'; name: MapName; surface: SortedSurface; deviation: DeviationBytes }
  | { kind: 'problem'; name: MapName; message: string };

type OnProgress = (share: number) => void;

/** Where surface and deviations come from. */
export interface MapSource {
  surface(onProgress: OnProgress, signal: AbortSignal): Promise<SortedSurface>;
  deviation(to: MapName, onProgress: OnProgress, signal: AbortSignal): Promise<DeviationBytes>;
}

/** The map of a session that is chosen, as far as it is there; what was fetched is kept. */
export class SurfaceMap {
  readonly state = signal<MapState>({ kind: 'none' });
  private surface: SortedSurface | null = null;
  private readonly deviations = new Map<MapName, DeviationBytes>();
  private underWay: AbortController | null = null;

  constructor(private readonly source: MapSource) {}

  get name(): MapName | null {
    const state = this.state.value;
    return state.kind === 'none' ? null : state.name;
  }

  async choose(name: MapName | null): Promise<void> {
    this.underWay?.abort();
    if (name === null) {
      this.state.value = { kind: 'none' };
      return;
    }
    const mine = (this.underWay = new AbortController());
    const onProgress = (share: number) => {
      if (mine === this.underWay) this.state.value = { kind: 'making', name, share };
    };
    onProgress(0);
    try {
      // One after the other: the server makes both from one reading of the recording.
      const deviation = this.deviations.get(name) ?? (await this.source.deviation(name, onProgress, mine.signal));
      this.deviations.set(name, deviation);
      const surface = this.surface ?? (await this.source.surface(onProgress, mine.signal));
      this.surface = surface;
      if (mine !== this.underWay) return;
      this.take(name, surface, deviation);
    } catch (error) {
      if (mine !== this.underWay || mine.signal.aborted) return;
      this.state.value = { kind: 'problem', name, message: mapErrorText(error) };
    }
  }

  dispose(): void {
    this.underWay?.abort();
    this.underWay = null;
  }

  private take(name: MapName, surface: SortedSurface, deviation: DeviationBytes): void {
    batch(() => {
      if (deviation.bytes.length * 3 === surface.positions.length) {
        this.state.value = { kind: 'ready', name, surface, deviation };
        return;
      }
      this.surface = null;
      this.deviations.clear();
      this.state.value = { kind: 'problem', name, message: reviewText.noMap.mismatch };
    });
  }
}

function mapErrorText(error: unknown): string {
  if (error instanceof ApiError) return mapErrorMessage(error);
  return reviewText.noMap.other(messageOf(error));
}
