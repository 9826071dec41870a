/** Worker: plays the recording of a review file, its bone computed by the twin, off the page's thread. */
import { causeFile, partsOf } from '../twin/part_file';
import { TwinModule } from '../twin/twin_module';
import { transferables } from '../wire/decode';
import type { StreamMessage } from '../wire/messages';
import type { PlaybackChange } from '../wire/rest_types';
import { FileReplay } from './file_replay';
import type { TimedMessage } from './review_parts';

/** Page to worker; `open` comes first, and once. */
export type ReplayRequest =
  | { kind: 'open'; module: Blob; causes: Blob; messages: readonly TimedMessage[] }
  | { kind: 'change'; change: PlaybackChange };

/** Worker to page. */
export type ReplayReport =
  | { kind: 'message'; message: StreamMessage }
  /** The bone cannot be computed any further. */
  | { kind: 'stuck' }
  | { kind: 'problem'; message: string };

// The DOM's typing of `self` is a window's; a worker's postMessage takes the transfer list in second place.
const page = self as unknown as { postMessage(report: ReplayReport, transfer?: ArrayBuffer[]): void };

const frameMs = 16;

/** What is wanted before the files are read. */
const waiting: PlaybackChange[] = [];
let replay: FileReplay | null = null;

async function open({ module, causes, messages }: Extract<ReplayRequest, { kind: 'open' }>): Promise<void> {
  const twin = await TwinModule.load(await module.arrayBuffer());
  const parts: Uint8Array[] = [];
  for await (const part of partsOf(causeFile, causes.stream())) parts.push(part);
  const send = (message: StreamMessage) => page.postMessage({ kind: 'message', message }, transferables(message));
  replay = new FileReplay({ twin, causes: parts, messages }, send);
  for (const change of waiting) replay.change(change);
  play(replay);
}

function play(opened: FileReplay): void {
  let beforeMs = performance.now();
  let stuck = false;
  const turn = () => {
    const nowMs = performance.now();
    const more = opened.advance(nowMs - beforeMs, nowMs);
    beforeMs = nowMs;
    if (!opened.agrees && !stuck) page.postMessage({ kind: 'stuck' });
    stuck = !opened.agrees;
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
  page.postMessage({ kind: 'problem', message: String(error) });
}

self.onmessage = ({ data }: MessageEvent<ReplayRequest>) => {
  if (data.kind === 'open') open(data).catch(fail);
  else if (replay === null) waiting.push(data.change);
  else replay.change(data.change);
};
