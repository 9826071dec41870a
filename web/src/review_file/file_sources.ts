import type { OpenSources } from '../panels/review/review_workspace';
import type { ReviewSources } from '../state/review/review_session';
import { unreadableFile } from '../state/review/session_error';
import type { VerificationSources } from '../state/review/session_verification';
import { reviewText } from '../text/review_text';
import { verifyBy } from '../twin/verify';
import VerificationWorker from '../twin/verification_worker?worker&inline';
import { askWorker } from '../wire/ask_worker';
import type { PlaybackChange, Replay, Session } from '../wire/rest_types';
import { ApiError } from '../wire/rest';
import type { DeviationBytes, MapName } from '../wire/review_api';
import type { SortedSurface } from '../wire/sorted_surface';
import type { StreamMessage } from '../wire/messages';
import type { StreamHandlers, StreamSocket } from '../wire/stream_socket';
import type { Obstacle } from './obstacle';
import type { ReplayReport, ReplayRequest } from './replay_worker';
import ReplayWorker from './replay_worker?worker&inline';
import type { ReviewParts } from './review_parts';
import type { SurfaceReport, SurfaceRequest } from './surface_worker';
import SurfaceWorker from './surface_worker?worker&inline';

/** All that a review file holds. */
export interface ReviewFile extends ReviewParts {
  causes: Blob;
  /** The twin's WebAssembly. */
  module: Blob;
}

/** A session as REST would have it, as far as a review asks for it. */
function sessionOf({ facts: { session, ticks } }: ReviewFile): Session {
  const device = { name: session.device };
  return { ...session, device, duration_s: ticks / 1000, tick: ticks } as unknown as Session;
}

export function fileVerification({ causes, module }: ReviewFile): VerificationSources {
  return {
    causes: () => Promise.resolve(causes),
    verify: (of, onTicks, signal) => verifyBy(() => new VerificationWorker(), { causes: of, module }, onTicks, signal),
  };
}

/** The session of a review file, in the place of a server. */
export function fileSources(file: ReviewFile): OpenSources {
  const player = new ReplayOfFile(file);
  const { facts } = file;
  const sources: ReviewSources = {
    api: player,
    socket: player,
    review: {
      session: () => Promise.resolve(sessionOf(file)),
      score: () => Promise.resolve(facts.score),
      trace: () => Promise.resolve(facts.trace),
      annotations: () =>
        Promise.resolve(
          facts.marks
            .filter(({ kind }) => kind === 'annotation')
            .map(({ at_s, words }) => ({ at_s, words, author: '', utc: '', place_mm: null })),
        ),
      deviation: (_id, to) => deviationOf(file, to),
    },
    surface: (_id, onProgress, signal) => surfaceLeft(file, onProgress, signal),
    mayReadTrace: true,
  };
  return {
    sources,
    follow(session) {
      player.onWarning = (words) => (session.store.recordingWarning.value = words);
      return { liveCase: null, dispose: () => (player.onWarning = () => undefined) };
    },
    dispose: () => player.dispose(),
  };
}

function deviationOf({ maps, facts: { map } }: ReviewFile, to: MapName): Promise<DeviationBytes> {
  const bytes = maps.get(to);
  if (bytes === undefined) return Promise.reject(new ApiError(reviewText.fileHasNoMap, 404));
  const [stepMm, rangeMm] = to === 'wall' ? [map.wall_step_mm, map.wall_range_mm] : [map.step_mm, map.range_mm];
  return Promise.resolve({ bytes, code: { stepMm, rangeMm, unknown: map.unknown } });
}

/** The bone as it was left, computed from its causes. */
function surfaceLeft(
  { module, causes, hello, facts }: ReviewFile,
  onProgress: (share: number) => void,
  signal: AbortSignal,
): Promise<SortedSurface> {
  // In its own words: no server has said anything.
  const failed = (obstacle: Obstacle) => new Error(obstacleWords[obstacle]);
  return askWorker<SurfaceRequest, SurfaceReport, SortedSurface>(
    () => new SurfaceWorker(),
    { module, causes, hello },
    signal,
    (report, { resolve, reject }) => {
      if (report.kind === 'ticks') onProgress(report.ticks / Math.max(facts.ticks, 1));
      else if (report.kind === 'surface') resolve(report.surface);
      else reject(failed(report.obstacle));
    },
    ({ reject }) => reject(failed('browser')),
  );
}

const obstacleWords: Record<Obstacle, string> = {
  file: reviewText.fileDamaged,
  browser: reviewText.notVerified.browser,
};

/** The recording as a worker plays it: both what is asked of a replay, and its stream. */
class ReplayOfFile implements StreamSocket {
  onWarning: (words: string) => void = () => undefined;
  private worker: Worker | null = null;
  private warning: string | null;
  /** Why it cannot be played. */
  private refusal: ApiError | null = null;
  /** Where it stood last; there another worker goes on. */
  private last: PlaybackChange = {};
  /** Changes that this worker has been sent. */
  private changes = 0;
  private waiting: { change: number; resolve: () => void }[] = [];

  constructor(private readonly file: ReviewFile) {
    this.warning = file.facts.warning || null;
  }

  openReplay(): Promise<Replay> {
    const { refusal } = this;
    this.refusal = null;
    return refusal === null ? Promise.resolve(this.described()) : Promise.reject(refusal);
  }
  replay(): Promise<Replay> {
    // Then it is opened again, and refused.
    if (this.refusal !== null) return Promise.reject(new ApiError('', 404));
    return Promise.resolve(this.described());
  }
  /** A place that is sought has been reached then, so that the slider waits for it. */
  async changePlayback(_id: string, change: PlaybackChange): Promise<Replay> {
    this.last = { ...this.last, ...change };
    this.change(change);
    if (this.worker !== null && change.position_s !== undefined) {
      const number = this.changes;
      await new Promise<void>((resolve) => this.waiting.push({ change: number, resolve }));
    }
    return this.described();
  }
  streamUrl(): string {
    return '';
  }

  open(_url: string, handlers: StreamHandlers): void {
    this.close();
    const worker = new ReplayWorker();
    this.worker = worker;
    this.changes = 0;
    const refuse = (obstacle: Obstacle) => {
      this.refusal = new ApiError(obstacleWords[obstacle], unreadableFile);
      handlers.onClosed(obstacleWords[obstacle]);
    };
    worker.onmessage = ({ data }: MessageEvent<ReplayReport>) => {
      if (worker !== this.worker) return;
      if (data.kind === 'message') {
        this.noteWhere(data.message);
        handlers.onMessage(data.message);
      } else if (data.kind === 'reached') this.settle(data.changes);
      else if (data.kind === 'stuck') this.onWarning((this.warning = reviewText.notAgreeingFile));
      else refuse(data.obstacle);
    };
    worker.onerror = () => {
      if (worker === this.worker) refuse('browser');
    };
    const { module, causes, hello, telemetry, tools } = this.file;
    this.send({ kind: 'open', module, causes, hello, telemetry, tools });
    if (this.last.position_s !== undefined) this.change(this.last);
  }

  close(): void {
    this.worker?.terminate();
    this.worker = null;
    this.settle(Infinity);
  }

  dispose(): void {
    this.close();
  }

  private noteWhere(message: StreamMessage): void {
    if (message.kind !== 'telemetry' || message.telemetry.playback === null || this.waiting.length > 0) return;
    const { positionTicks, playing, speed } = message.telemetry.playback;
    this.last = { position_s: positionTicks / 1000, playing, speed };
  }

  private settle(changes: number): void {
    const done = this.waiting.filter(({ change }) => change <= changes);
    this.waiting = this.waiting.filter(({ change }) => change > changes);
    for (const { resolve } of done) resolve();
  }

  private change(change: PlaybackChange): void {
    if (this.worker === null) return;
    ++this.changes;
    this.send({ kind: 'change', change });
  }

  private send(request: ReplayRequest): void {
    this.worker?.postMessage(request);
  }

  private described(): Replay {
    const { marks, session } = this.file.facts;
    return { ...sessionOf(this.file), id: session.id, marks, warning: this.warning } as unknown as Replay;
  }
}
