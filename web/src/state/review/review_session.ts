import { computed, effect, signal } from '@preact/signals';

import type { Api } from '../../wire/api';
import { ApiError, messageOf } from '../../wire/rest';
import { type MapName, mapNames, type ReviewApi } from '../../wire/review_api';
import type { StreamSocket } from '../../wire/stream_socket';
import type { SortedSurface } from '../../wire/sorted_surface';
import { Remote } from '../remote';
import { Store } from '../store';
import type { Triple } from '../../wire/messages';
import { withPlace } from './measuring';
import { type Picture, ReplayPlayer } from './replay_player';
import { readTrace, type SessionTrace, traceStride } from './session_trace';
import { SurfaceMap } from './surface_map';
import { eventsOfTrace, isEnd, mergedMarks, neighbouringMark } from './timeline';
import { type SessionError, sessionErrorOf } from './session_error';
import type { Mark, Session } from '../../wire/rest_types';

/** A deleted session is noticed after this time. */
const lookAgainMs = 10_000;

/** A place of the bone that was pointed at, in the CT's frame. */
export interface MeasuredPlace {
  at: Triple;
  /** How far the surface lies off there by the map that was seen; null: there was none, or nothing to compare. */
  deviation: { mm: number; to: MapName } | null;
}

export interface ReviewSources {
  api: Pick<Api, 'openReplay' | 'replay' | 'changePlayback' | 'streamUrl'>;
  review: Pick<ReviewApi, 'session' | 'score' | 'trace' | 'deviation' | 'annotations'> &
    Partial<Pick<ReviewApi, 'annotate'>>;
  socket: StreamSocket;
  surface(id: string, onProgress: (share: number) => void, signal: AbortSignal): Promise<SortedSurface>;
  /** A viewer link has no trace. */
  mayReadTrace: boolean;
}

/** One session that is looked at after its end: its recording, score, forces, maps, and what was measured on it. */
export class ReviewSession {
  readonly store = new Store();
  readonly player: ReplayPlayer;
  readonly score: Remote<Awaited<ReturnType<ReviewApi['score']>>>;
  readonly map: SurfaceMap;
  readonly details = signal<Session | null>(null);
  readonly trace = signal<SessionTrace | null>(null);
  readonly traceProblem = signal<string | null>(null);
  readonly places = signal<readonly MeasuredPlace[]>([]);
  /** Nothing was at the place that was pointed at last. */
  readonly missed = signal(false);
  /** Null until they are read; a replay knows those that were there when it was opened. */
  private readonly annotations = signal<readonly Mark[] | null>(null);
  private readonly gone = signal<ApiError | null>(null);
  private readonly timer: ReturnType<typeof setInterval>;
  private readonly stopFollowing: () => void;
  private disposed = false;
  private traceUnderWay = false;

  get mayReadTrace(): boolean {
    return this.sources.mayReadTrace;
  }
  readonly durationS = computed(() => {
    const recorded = (this.store.hello.value?.durationTicks ?? 0) / 1000;
    return recorded > 0 ? recorded : (this.details.value?.duration_s ?? 0);
  });
  readonly positionS = computed(
    () => this.player.scrubber.wantedS.value ?? (this.store.playback.value?.positionTicks ?? 0) / 1000,
  );
  readonly atEnd = computed(() => {
    const { hello, playback } = this.store;
    return playback.value !== null && isEnd(playback.value.positionTicks, hello.value?.durationTicks ?? 0);
  });
  readonly atStart = computed(() => this.store.playback.value?.positionTicks === 0);
  readonly marks = computed(() => {
    const [trace, annotations] = [this.trace.value, this.annotations.value];
    const recorded = this.store.marks.value.filter(({ kind }) => annotations === null || kind !== 'annotation');
    return mergedMarks([...recorded, ...(annotations ?? [])], trace === null ? [] : eventsOfTrace(trace));
  });
  readonly error = computed<SessionError | null>(() => {
    const refused = this.gone.value ?? this.player.refused.value;
    return refused === null ? null : sessionErrorOf(refused);
  });
  /** The map that is seen now: it is of the end. */
  readonly mapShown = computed(() => {
    const state = this.map.state.value;
    return state.kind === 'ready' && this.atEnd.value ? state : null;
  });

  constructor(
    readonly id: string,
    private readonly sources: ReviewSources,
    picture: Picture,
  ) {
    this.player = new ReplayPlayer(id, this.store, sources.api, sources.socket, picture);
    this.score = new Remote(() => sources.review.score(id));
    this.map = new SurfaceMap({
      surface: (onProgress, abort) => sources.surface(id, onProgress, abort),
      deviation: (to, onProgress, abort) => sources.review.deviation(id, to, onProgress, abort),
    });
    this.timer = setInterval(() => void this.readDetails(), lookAgainMs);
    // What came while the server did not answer is asked for again when it does.
    this.stopFollowing = effect(() => {
      if (this.store.link.value.kind !== 'live') return;
      if (this.score.problem.peek() !== null) void this.score.read();
      if (this.traceProblem.peek() !== null) void this.readTrace();
    });
  }

  start(): void {
    this.player.start();
    void this.readDetails();
    void this.score.read();
    void this.readAnnotations();
  }

  /** After something could not be had. */
  tryAgain(): void {
    this.gone.value = null;
    this.start();
  }

  dispose(): void {
    this.disposed = true;
    clearInterval(this.timer);
    this.stopFollowing();
    this.player.stop();
    this.map.dispose();
  }

  seek(positionS: number): void {
    this.player.scrubber.seek(Math.min(Math.max(positionS, 0), this.durationS.peek()));
  }
  showBefore(): void {
    void this.player.play({ playing: false });
    this.seek(0);
  }
  showAfter(): void {
    void this.player.play({ playing: false });
    this.seek(this.durationS.peek());
  }
  toggleBefore(): void {
    if (this.atStart.peek()) this.showAfter();
    else this.showBefore();
  }
  togglePlay(): void {
    void this.player.play({ playing: this.store.playback.peek()?.playing !== true });
  }
  seekEvent(forwards: boolean): void {
    const mark = neighbouringMark(this.marks.peek(), this.positionS.peek(), forwards);
    if (mark !== null) this.seek(mark.at_s);
  }

  /** A map is of the end, where it leads. */
  chooseMap(name: MapName | null): void {
    if (name !== null && !this.atEnd.peek()) this.showAfter();
    void this.map.choose(name);
  }
  nextMap(): void {
    const { name } = this.map;
    this.chooseMap(mapNames[name === null ? 0 : mapNames.indexOf(name) + 1] ?? null);
  }

  measureAt(place: MeasuredPlace | null): void {
    this.missed.value = place === null;
    if (place !== null) this.places.value = withPlace(this.places.peek(), place);
  }

  /** Keeps an annotation of the present moment; throws ApiError. */
  async annotate(text: string): Promise<void> {
    const atS = this.positionS.peek();
    await this.sources.review.annotate?.(this.id, text, atS);
    await this.readAnnotations();
  }

  /** Without them those are shown that the replay knows. */
  private async readAnnotations(): Promise<void> {
    const found = await this.sources.review.annotations(this.id).catch(() => null);
    if (found === null || this.disposed) return;
    this.annotations.value = found.map(({ at_s, words }) => ({ at_s, kind: 'annotation', words }));
  }

  private async readDetails(): Promise<void> {
    try {
      const details = await this.sources.review.session(this.id);
      if (this.disposed) return;
      this.details.value = details;
      if (this.gone.peek() !== null) this.tryAgain();
      if (this.trace.peek() === null) void this.readTrace();
    } catch (error) {
      if (this.disposed || !(error instanceof ApiError) || error.status !== 404 || this.gone.peek() !== null) return;
      this.gone.value = error;
      this.player.stop();
    }
  }

  private async readTrace(): Promise<void> {
    const ticks = this.details.peek()?.tick ?? 0;
    if (!this.sources.mayReadTrace || ticks === 0 || this.traceUnderWay) return;
    this.traceUnderWay = true;
    try {
      this.trace.value = readTrace(await this.sources.review.trace(this.id, traceStride(ticks)));
      this.traceProblem.value = null;
    } catch (error) {
      this.traceProblem.value = messageOf(error);
    } finally {
      this.traceUnderWay = false;
    }
  }
}
