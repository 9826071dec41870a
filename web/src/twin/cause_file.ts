const magic = 'reamtwin';
const revision = 1;
const headBytes = magic.length + 4;
/** No part is larger: a bone of a GiB and a byte for each of its bricks. */
const maxPartBytes = 2 ** 30 + 2 ** 22;

/** The bytes are no file of causes. */
export class CauseFileError extends Error {}

/** The parts of a file of causes (server/twin/cause_file.hpp), as they come. Throws CauseFileError for another file, and TypeError for one that cannot be unpacked. */
export async function* causeParts(packed: ReadableStream<Uint8Array<ArrayBuffer>>): AsyncGenerator<Uint8Array> {
  const reader = packed.pipeThrough(new DecompressionStream('gzip')).getReader();
  let rest = new Uint8Array(0);
  /** The next bytes; null at the end of the file, which must not lie within them. */
  const next = async (count: number): Promise<Uint8Array | null> => {
    const pieces = [rest];
    for (let have = rest.length; have < count;) {
      const { value, done } = await reader.read();
      if (done && have === 0) return null;
      if (done) throw new CauseFileError('the file of causes is cut short');
      pieces.push(value);
      have += value.length;
    }
    const all = pieces.length === 1 ? rest : joined(pieces);
    rest = all.subarray(count);
    return all.subarray(0, count);
  };
  const head = await next(headBytes);
  if (head === null || new TextDecoder().decode(head.subarray(0, magic.length)) !== magic)
    throw new CauseFileError('this is no file of causes');
  if (u32(head, magic.length) !== revision) throw new CauseFileError('the file of causes is of another revision');
  for (let length = await next(4); length !== null; length = await next(4)) {
    if (u32(length, 0) > maxPartBytes) throw new CauseFileError('a part is larger than any bone');
    const part = await next(u32(length, 0));
    if (part === null) throw new CauseFileError('the file of causes is cut short');
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
