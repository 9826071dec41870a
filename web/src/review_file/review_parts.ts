import { PartFileError, type PartFileKind, partsOf } from '../twin/part_file';
import type { Mark, Score, Session } from '../wire/rest_types';
import { type MapName, mapNames } from '../wire/review_api';

const reviewFile: PartFileKind = { magic: 'reamview', revision: 1 };

/** What is not known is empty. */
export interface SessionFacts {
  id: string;
  title: string;
  trainee: string;
  participant: string;
  attempt: number;
  theatre: boolean;
  case: string;
  created_utc: string;
  /** Its name: "script" is nobody's hand. */
  device: string;
  state: Session['state'];
  fault: string;
}

/** What a review file says in JSON. */
export interface ReviewFacts {
  /** That has written it. */
  program: string;
  session: SessionFacts;
  score: Score;
  marks: Mark[];
  ticks: number;
  /** CSV of the timeline. */
  trace: string;
  /** What of the recording is left out; empty: nothing. */
  warning: string;
  /** Steps and ranges of the maps' bytes, mm. */
  map: { step_mm: number; range_mm: number; wall_step_mm: number; wall_range_mm: number; unknown: number };
}

/** A message of the stream that holds when so many ticks have passed. */
export interface TimedMessage {
  atTicks: number;
  bytes: Uint8Array<ArrayBuffer>;
}

/** A review file's parts (proto/causes.md) but for its causes; messages in order of time. */
export interface ReviewParts {
  facts: ReviewFacts;
  /** The stream's first message. */
  hello: Uint8Array<ArrayBuffer>;
  telemetry: readonly TimedMessage[];
  tools: readonly TimedMessage[];
  maps: ReadonlyMap<MapName, Int8Array<ArrayBuffer>>;
}

/** Reads them. Throws PartFileError, SyntaxError or TypeError for a file that is damaged. */
export async function readReviewParts(packed: Uint8Array<ArrayBuffer>): Promise<ReviewParts> {
  let facts: ReviewFacts | null = null;
  let hello: Uint8Array<ArrayBuffer> | null = null;
  const telemetry: TimedMessage[] = [];
  const tools: TimedMessage[] = [];
  const maps = new Map<MapName, Int8Array<ArrayBuffer>>();
  for await (const part of partsOf(reviewFile, new Blob([packed]).stream())) {
    // Copied: a part is a view of the whole file.
    const body = part.slice(1);
    switch (part[0]) {
      case 1:
        facts = JSON.parse(new TextDecoder().decode(body)) as ReviewFacts;
        break;
      case 2:
        hello = body;
        break;
      case 3:
        telemetry.push(timed(body));
        break;
      case 4:
        tools.push(timed(body));
        break;
      case 5: {
        const name = mapNames[body[0] ?? mapNames.length];
        if (name !== undefined) maps.set(name, new Int8Array(body.buffer.slice(1)));
        break;
      }
      case undefined:
      default:
        throw new PartFileError(`a part has the code ${String(part[0])}`);
    }
  }
  if (facts === null || hello === null || telemetry.length === 0) throw new PartFileError('the file is cut short');
  return { facts, hello, telemetry, tools, maps };
}

const tickBytes = 4;

function timed(body: Uint8Array<ArrayBuffer>): TimedMessage {
  if (body.length < tickBytes) throw new PartFileError('a message is too short');
  return { atTicks: new DataView(body.buffer).getUint32(0, true), bytes: body.slice(tickBytes) };
}
