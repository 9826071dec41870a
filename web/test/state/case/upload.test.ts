import { beforeEach, describe, expect, it } from 'vitest';

import { pieceBytes, uploadFile, type UploadCallbacks, type UploadSource } from '../../../src/state/case/upload';
import type { Upload } from '../../../src/wire/rest_types';
import { ApiError } from '../../../src/wire/rest';

/** The server's side of uploads, which can lose answers. */
class FakeUploads {
  readonly kept = new Map<string, { upload: Upload; bytes: number[] }>();
  /** What happens to the next pieces: lost before they arrive, or their answer lost. */
  readonly failures: ('lost' | 'unanswered' | 'refused' | null)[] = [];
  pieces = 0;

  private find(id: string) {
    const found = this.kept.get(id);
    if (found === undefined) throw new ApiError(`no upload '${id}'`, 404);
    return found;
  }
  beginUpload = (name: string, bytes: number) => {
    const upload = { id: `u${this.kept.size + 1}`, name, bytes, received: 0 };
    this.kept.set(upload.id, { upload, bytes: [] });
    return Promise.resolve({ ...upload });
  };
  upload = (id: string) => Promise.resolve().then(() => ({ ...this.find(id).upload }));
  dropUpload = () => Promise.resolve();
  sendPiece = (id: string, offset: number, body: Uint8Array) =>
    Promise.resolve().then(() => {
      ++this.pieces;
      const failure = this.failures.shift() ?? null;
      if (failure === 'lost') throw new ApiError('no answer', 0);
      if (failure === 'refused') throw new ApiError('too large', 413);
      const { upload, bytes } = this.find(id);
      if (offset !== upload.received) throw new ApiError(`begins at ${upload.received}`, 409);
      expect(body.length).toBeLessThanOrEqual(pieceBytes);
      bytes.push(...body.subarray(0, 4));
      upload.received += body.length;
      if (failure === 'unanswered') throw new ApiError('no answer', 0);
      return { ...upload };
    });
}

const size = 2.5 * pieceBytes;
const file: UploadSource = {
  name: 'shoulder.zip',
  size,
  lastModified: 5,
  slice: (from, to) => ({ arrayBuffer: () => Promise.resolve(new ArrayBuffer(to - from)) }),
};

let api: FakeUploads;
let progress: number[];
let waits: boolean[];
let memory: Map<string, string>;
let callbacks: UploadCallbacks;

beforeEach(() => {
  api = new FakeUploads();
  progress = [];
  waits = [];
  memory = new Map();
  callbacks = {
    api,
    remembered: {
      getItem: (key) => memory.get(key) ?? null,
      setItem: (key, value) => void memory.set(key, value),
      removeItem: (key) => void memory.delete(key),
    },
    onProgress: (received) => progress.push(received),
    onWaiting: (waiting) => waits.push(waiting),
    pause: () => Promise.resolve(),
  };
});

const never = new AbortController().signal;

describe('uploadFile', () => {
  it('sends a file in pieces, in order, and tells how far it is', async () => {
    const upload = await uploadFile(file, callbacks, never);
    expect(upload.received).toBe(size);
    expect(api.pieces).toBe(3);
    expect(progress).toEqual([0, pieceBytes, 2 * pieceBytes, size]);
    expect(waits).toEqual([]);
  });

  it('goes on after pieces and answers were lost, sending nothing twice', async () => {
    api.failures.push(null, 'lost', 'unanswered', null);
    const upload = await uploadFile(file, callbacks, never);
    expect(upload.received).toBe(size);
    expect(waits[0]).toBe(true);
    expect(waits.at(-1)).toBe(false);
    expect(api.pieces).toBe(4);
  });

  it('gives up after a while, and goes on from there when tried again', async () => {
    api.failures.push(null, ...Array.from({ length: 6 }, () => 'lost' as const));
    await expect(uploadFile(file, callbacks, never)).rejects.toThrow('no answer');
    progress = [];
    await uploadFile(file, callbacks, never);
    expect(progress[0]).toBe(pieceBytes);
    expect(api.kept.size).toBe(1);
  });

  it('does not repeat what the server refuses', async () => {
    api.failures.push('refused');
    await expect(uploadFile(file, callbacks, never)).rejects.toThrow('too large');
    expect(api.pieces).toBe(1);
  });

  it('begins anew when the server has forgotten the upload', async () => {
    callbacks.remembered.setItem('ream.upload.2621440.5', 'gone');
    const upload = await uploadFile(file, callbacks, never);
    expect(upload.id).toBe('u1');
  });

  it('leaves no name of a file, which is often a patient, on this computer', async () => {
    await uploadFile({ ...file, name: 'DOE_Jane_19560312.zip' }, callbacks, never);
    expect(memory.size).toBe(1);
    expect([...memory].join()).not.toMatch(/doe|jane|1956/i);
  });

  it('does not go on with a file of another name', async () => {
    await uploadFile(file, callbacks, never);
    await uploadFile({ ...file, name: 'other.zip' }, callbacks, never);
    expect(api.kept.size).toBe(2);
  });

  it('does not take another file of the same name for it', async () => {
    await uploadFile(file, callbacks, never);
    await uploadFile({ ...file, lastModified: 6 }, callbacks, never);
    expect(api.kept.size).toBe(2);
  });

  it('ends at once when it is not wanted any more', async () => {
    const abort = new AbortController();
    callbacks.onProgress = (received) => received > 0 && abort.abort();
    await expect(uploadFile(file, callbacks, abort.signal)).rejects.toThrow();
    expect(api.pieces).toBe(1);
  });
});
