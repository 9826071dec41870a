/** Worker: plays the recording of a review file, its bone computed by the twin, off the page's thread. */
import { causeFile, PartFileError, partsOf } from '../twin/part_file';
import { TwinModule } from '../twin/twin_module';
import { StreamDecoder, transferables } from '../wire/decode';
import type { StreamMessage } from '../wire/messages';
import type { PlaybackChange } from '../wire/rest_types';
import { FileReplay } from './file_replay';
import { type Obstacle, obstacleOf } from './obstacle';
import type { ReviewParts } from './review_parts';

/** Page to worker; `open` comes first, and once. */
export type ReplayRequest =
  | ({ kind: 'open'; module: Blob; causes: Blob } & Pick<ReviewParts, 'hello' | 'telemetry' | 'tools'>)
  | { kind: 'change'; change: PlaybackChange };

/** Worker to page. */
export type ReplayReport =
  | { kind: 'message'; message: StreamMessage }
  /** So many changes have been carried out, and what they led to is shown. */
  | { kind: 'reached'; changes: number }
  /** From somewhere on the bone does not agree with the recording. */
  | { kind: 'stuck' }
  | { kind: 'problem'; obstacle: Obstacle };

// The DOM's typing of `self` is a window's; a worker's postMessage takes the transfer list in second place.
const page = self as unknown as { postMessage(report: ReplayReport, transfer?: ArrayBuffer[]): void };

const frameMs = 16;

/** What is wanted before the files are read. */
const waiting: PlaybackChange[] = [];
let replay: FileReplay | null = null;

const send = (message: StreamMessage) => page.postMessage({ kind: 'message', message }, transferables(message));

async function open({ module, causes, hello, ...messages }: Extract<ReplayRequest, { kind: 'open' }>): Promise<void> {
  const decoder = new StreamDecoder();
  const decoded = decoder.decode(hello);
  if (decoded.kind !== 'hello') throw new PartFileError('the file does not begin with a hello');
  // At once, as a link that says nothing is given up; what follows is kept here, too.
  send(structuredClone(decoded));
  const twin = await TwinModule.load(await module.arrayBuffer());
  const parts: Uint8Array[] = [];
  for await (const part of partsOf(causeFile, causes.stream())) parts.push(part);
  replay = new FileReplay({ hello: decoded.hello, decoder, twin, causes: parts, ...messages }, send);
  for (const change of waiting) replay.change(change);
  play(replay);
}

function play(opened: FileReplay): void {
  let beforeMs = performance.now();
  let stuck = false;
  let reached = 0;
  const turn = () => {
    const nowMs = performance.now();
    const more = opened.advance(nowMs - beforeMs, nowMs);
    beforeMs = nowMs;
    if (opened.stuck && !stuck) page.postMessage({ kind: 'stuck' });
    stuck = opened.stuck;
    if (opened.reached !== null && opened.reached !== reached) {
      reached = opened.reached;
      page.postMessage({ kind: 'reached', changes: reached });
    }
    setTimeout(guarded, more ? 0 : frameMs);
  };
  const guarded = () => {
    try {
      turn();
    } catch (error) {
      fail(error);
    }
  };
  guarded();
}

function fail(error: unknown): void {
  console.error(error);
  page.postMessage({ kind: 'problem', obstacle: obstacleOf(error) });
}

self.onmessage = ({ data }: MessageEvent<ReplayRequest>) => {
  if (data.kind === 'open') open(data).catch(fail);
  else if (replay === null) waiting.push(data.change);
  else replay.change(data.change);
};
