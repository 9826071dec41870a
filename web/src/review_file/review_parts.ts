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
  map: { step_mm: number; wall_step_mm: number; unknown: number };
}

/** A message of the stream that holds when so many ticks have passed. */
export interface TimedMessage {
  atTicks: number;
  bytes: Uint8Array<ArrayBuffer>;
}

/** A review file's parts (session/export/review_file.hpp) but for its causes. */
export interface ReviewParts {
  facts: ReviewFacts;
  /** In order; the first is the hello. */
  messages: TimedMessage[];
  maps: ReadonlyMap<MapName, Int8Array<ArrayBuffer>>;
}

/** Reads them. Throws PartFileError, SyntaxError or TypeError for a file that is damaged. */
export async function readReviewParts(packed: Uint8Array<ArrayBuffer>): Promise<ReviewParts> {
  let facts: ReviewFacts | null = null;
  const messages: TimedMessage[] = [];
  const maps = new Map<MapName, Int8Array<ArrayBuffer>>();
  for await (const part of partsOf(reviewFile, new Blob([packed]).stream())) {
    // Copied: a part is a view of the whole file.
    const body = part.slice(1);
    switch (part[0]) {
      case 1:
        facts = JSON.parse(new TextDecoder().decode(body)) as ReviewFacts;
        break;
      case 2:
        if (body.length < 4) throw new PartFileError('a message is too short');
        messages.push({ atTicks: new DataView(body.buffer).getUint32(0, true), bytes: body.slice(4) });
        break;
      case 3: {
        const name = mapNames[body[0] ?? mapNames.length];
        if (name !== undefined) maps.set(name, new Int8Array(body.buffer.slice(1)));
        break;
      }
      case undefined:
      default:
        throw new PartFileError(`a part has the code ${String(part[0])}`);
    }
  }
  if (facts === null || messages.length === 0) throw new PartFileError('the file is cut short');
  return { facts, messages, maps };
}
