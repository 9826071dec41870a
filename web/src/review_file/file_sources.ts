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
import type { StreamHandlers, StreamSocket } from '../wire/stream_socket';
import type { ReplayReport, ReplayRequest } from './replay_worker';
import ReplayWorker from './replay_worker?worker&inline';
import type { ReviewParts } from './review_parts';
import type { SurfaceReport, SurfaceRequest } from './surface_worker';
import SurfaceWorker from './surface_worker?worker&inline';

const mostSteps = 127;

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
      annotate: () => Promise.reject(new ApiError(reviewText.fileIsKept, 409)),
      deviation: (_id, to) => deviationOf(file, to),
    },
    surface: (_id, onProgress, signal) => surfaceLeft(file, onProgress, signal),
    mayReadTrace: true,
  };
  return { sources, dispose: () => player.dispose() };
}

function deviationOf({ maps, facts: { map } }: ReviewFile, to: MapName): Promise<DeviationBytes> {
  const bytes = maps.get(to);
  if (bytes === undefined) return Promise.reject(new ApiError(reviewText.fileHasNoMap, 404));
  const stepMm = to === 'wall' ? map.wall_step_mm : map.step_mm;
  return Promise.resolve({ bytes, code: { stepMm, rangeMm: mostSteps * stepMm, unknown: map.unknown } });
}

/** The bone as it was left, computed from its causes. */
function surfaceLeft(
  { module, causes, messages, facts }: ReviewFile,
  onProgress: (share: number) => void,
  signal: AbortSignal,
): Promise<SortedSurface> {
  const failed = () => new ApiError(reviewText.fileDamaged, 422);
  const hello = messages[0]?.bytes;
  if (hello === undefined) return Promise.reject(failed());
  return askWorker<SurfaceRequest, SurfaceReport, SortedSurface>(
    () => new SurfaceWorker(),
    { module, causes, hello },
    signal,
    (report, { resolve, reject }) => {
      if (report.kind === 'ticks') onProgress(report.ticks / Math.max(facts.ticks, 1));
      else if (report.kind === 'surface') resolve(report.surface);
      else reject(failed());
    },
    ({ reject }) => reject(failed()),
  );
}

/** The recording as a worker plays it: both what is asked of a replay, and its stream. */
class ReplayOfFile implements StreamSocket {
  private worker: Worker | null = null;
  private warning: string | null = null;
  /** Why it cannot be played. */
  private refusal: ApiError | null = null;

  constructor(private readonly file: ReviewFile) {}

  openReplay(): Promise<Replay> {
    const { refusal } = this;
    this.refusal = null;
    if (refusal !== null) return Promise.reject(refusal);
    return Promise.resolve(this.described());
  }
  replay(): Promise<Replay> {
    // Then it is opened again, and refused.
    if (this.refusal !== null) return Promise.reject(new ApiError('', 404));
    return Promise.resolve(this.described());
  }
  changePlayback(_id: string, change: PlaybackChange): Promise<Replay> {
    this.send({ kind: 'change', change });
    return Promise.resolve(this.described());
  }
  streamUrl(): string {
    return '';
  }

  open(_url: string, handlers: StreamHandlers): void {
    this.close();
    const worker = new ReplayWorker();
    this.worker = worker;
    worker.onmessage = ({ data }: MessageEvent<ReplayReport>) => {
      if (worker !== this.worker) return;
      if (data.kind === 'message') handlers.onMessage(data.message);
      else if (data.kind === 'stuck') this.warning = reviewText.notAgreeingFile;
      else refuse(reviewText.fileDamaged);
    };
    worker.onerror = () => {
      if (worker === this.worker) refuse(reviewText.notVerified.browser);
    };
    const refuse = (words: string) => {
      this.refusal = new ApiError(words, unreadableFile);
      handlers.onClosed(words);
    };
    const { module, causes, messages } = this.file;
    this.send({ kind: 'open', module, causes, messages });
  }

  close(): void {
    this.worker?.terminate();
    this.worker = null;
  }

  dispose(): void {
    this.close();
  }

  private send(request: ReplayRequest): void {
    this.worker?.postMessage(request);
  }

  private described(): Replay {
    const { marks, session } = this.file.facts;
    return { ...sessionOf(this.file), id: session.id, marks, warning: this.warning } as unknown as Replay;
  }
}
