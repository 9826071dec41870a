/** Whether a file is damaged that could not be read: by its layout, or by its packing, of which DecompressionStream says TypeError. */
export const isDamage = (error: unknown): boolean => error instanceof PartFileError || error instanceof TypeError;

/** What a file of parts is: the 8 bytes that it begins with, and the revision that is read here. */
export interface PartFileKind {
  magic: string;
  revision: number;
}

export const causeFile: PartFileKind = { magic: 'reamtwin', revision: 1 };

const magicBytes = 8;
const headBytes = magicBytes + 4;
/** No part is larger: a bone of a GiB and a byte for each of its bricks. */
const maxPartBytes = 2 ** 30 + 2 ** 22;

/** The bytes are no such file. */
export class PartFileError extends Error {}

/** The parts of a file (server/twin/part_file.hpp), as they come. Throws PartFileError for another file, and TypeError for one that cannot be unpacked. */
export async function* partsOf(
  { magic, revision }: PartFileKind,
  packed: ReadableStream<Uint8Array<ArrayBuffer>>,
): AsyncGenerator<Uint8Array> {
  const reader = packed.pipeThrough(new DecompressionStream('gzip')).getReader();
  let rest = new Uint8Array(0);
  /** The next bytes; null at the end of the file, which must not lie within them. */
  const next = async (count: number): Promise<Uint8Array | null> => {
    const pieces = [rest];
    for (let have = rest.length; have < count;) {
      const { value, done } = await reader.read();
      if (done && have === 0) return null;
      if (done) throw new PartFileError('the file is cut short');
      pieces.push(value);
      have += value.length;
    }
    const all = pieces.length === 1 ? rest : joined(pieces);
    rest = all.subarray(count);
    return all.subarray(0, count);
  };
  const head = await next(headBytes);
  if (head === null || new TextDecoder().decode(head.subarray(0, magicBytes)) !== magic)
    throw new PartFileError(`the file does not begin with ${magic}`);
  if (u32(head, magicBytes) !== revision) throw new PartFileError('the file is of another revision');
  for (let length = await next(4); length !== null; length = await next(4)) {
    if (u32(length, 0) > maxPartBytes) throw new PartFileError('a part is larger than any bone');
    const part = await next(u32(length, 0));
    if (part === null) throw new PartFileError('the file is cut short');
    yield part;
  }
}

function joined(pieces: readonly Uint8Array[]): Uint8Array<ArrayBuffer> {
  const all = new Uint8Array(pieces.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const piece of pieces) {
    all.set(piece, at);
    at += piece.length;
  }
  return all;
}

const u32 = (bytes: Uint8Array, at: number) => new DataView(bytes.buffer, bytes.byteOffset).getUint32(at, true);
