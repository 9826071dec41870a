import type { CaseApi } from '../../wire/case_api';
import type { Upload } from '../../wire/rest_types';
import { ApiError } from '../../wire/rest';

export const pieceBytes = 1 << 20;
/** Pauses before the tries to go on after a broken link, ms; then the upload rests until it is resumed by hand. */
const retryPausesMs = [500, 1000, 2000, 4000, 8000];

export type UploadApi = Pick<CaseApi, 'beginUpload' | 'upload' | 'sendPiece' | 'dropUpload'>;

/** What an upload reads; a browser's File is one. */
export interface UploadSource {
  name: string;
  size: number;
  lastModified: number;
  slice(from: number, to: number): { arrayBuffer(): Promise<ArrayBuffer> };
}

export interface UploadCallbacks {
  api: UploadApi;
  /** Remembers which upload is of which file, so that a page loaded anew goes on where it was. */
  remembered: Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>;
  onProgress: (received: number, bytes: number) => void;
  /** The link is broken and is tried again. */
  onWaiting: (waiting: boolean) => void;
  pause: (ms: number) => Promise<void>;
}

/** Without the file's name, which is often the patient's: it would stay on this computer. */
const keyOf = (file: UploadSource) => `ream.upload.${file.size}.${file.lastModified}`;

/**
 * Sends a file in pieces and gives its upload, going on where the server is after a break. Throws ApiError when the
 * server refuses it or does not come back, and AbortError when `signal` ends it.
 */
export async function uploadFile(file: UploadSource, callbacks: UploadCallbacks, signal: AbortSignal): Promise<Upload> {
  let upload = await begin(file, callbacks);
  let failures = 0;
  while (upload.received < file.size) {
    callbacks.onProgress(upload.received, file.size);
    signal.throwIfAborted();
    try {
      const to = Math.min(upload.received + pieceBytes, file.size);
      const piece = new Uint8Array(await file.slice(upload.received, to).arrayBuffer());
      upload = await callbacks.api.sendPiece(upload.id, upload.received, piece, signal);
      if (failures > 0) callbacks.onWaiting(false);
      failures = 0;
    } catch (error) {
      signal.throwIfAborted();
      upload = await recover(error, upload, failures++, callbacks, signal);
    }
  }
  callbacks.onProgress(file.size, file.size);
  return upload;
}

/** The upload is no longer of use, because it became a case or is not wanted. */
export function forgetUpload(file: UploadSource, remembered: UploadCallbacks['remembered']): void {
  remembered.removeItem(keyOf(file));
}

/** What has arrived of a file is not wanted any more. */
export async function dropUpload(file: UploadSource, { api, remembered }: Pick<UploadCallbacks, 'api' | 'remembered'>) {
  const id = remembered.getItem(keyOf(file));
  forgetUpload(file, remembered);
  if (id !== null) await api.dropUpload(id).catch(() => undefined);
}

async function begin(file: UploadSource, { api, remembered }: UploadCallbacks): Promise<Upload> {
  const earlier = remembered.getItem(keyOf(file));
  if (earlier !== null) {
    const known = await api.upload(earlier).catch((error: unknown) => {
      if (error instanceof ApiError && error.status === 404) return null;
      throw error;
    });
    if (known !== null && known.bytes === file.size && known.name === file.name) return known;
  }
  const made = await api.beginUpload(file.name, file.size);
  remembered.setItem(keyOf(file), made.id);
  return made;
}

/** Where the server is, once it answers again; refusals other than a wrong offset are final. */
async function recover(
  error: unknown,
  upload: Upload,
  failures: number,
  { api, onWaiting, pause }: UploadCallbacks,
  signal: AbortSignal,
): Promise<Upload> {
  const passing = error instanceof ApiError && (error.status === 0 || error.status === 409 || error.status >= 500);
  const pauseMs = retryPausesMs[failures];
  if (!passing || pauseMs === undefined) throw error;
  if (error.status !== 409 || failures > 0) {
    onWaiting(true);
    await pause(pauseMs);
    signal.throwIfAborted();
  }
  return api.upload(upload.id).catch((again: unknown) => {
    if (again instanceof ApiError && again.status === 0) return upload;
    throw again;
  });
}
