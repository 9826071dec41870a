import { words } from '../words';

/** What the server, or the way to it, answered instead of what was asked for; the message is for people. */
export class ApiError extends Error {
  constructor(
    message: string,
    /** HTTP status, 0 when there was no answer. */
    readonly status: number,
  ) {
    super(message);
  }
}

export type Method = 'GET' | 'POST' | 'PUT' | 'DELETE';

// The first session of a fresh server waits until the demo case is made.
const timeoutMs: Record<Method, number> = { GET: 10000, POST: 60000, PUT: 60000, DELETE: 10000 };

export interface CallOptions {
  /** Sent as JSON, or as bytes where it is an array of them. */
  body?: object | Uint8Array<ArrayBuffer>;
  signal?: AbortSignal;
}

/** One call of the REST interface; throws ApiError for anything but success, and AbortError when given up. */
export async function request(url: string, method: Method, options: CallOptions = {}): Promise<Response> {
  const { body, signal } = options;
  const bytes = body instanceof Uint8Array;
  const type = bytes ? 'application/octet-stream' : 'application/json';
  const timeout = AbortSignal.timeout(timeoutMs[method]);
  let response: Response;
  try {
    response = await fetch(url, {
      method,
      cache: 'no-store',
      headers: body === undefined ? {} : { 'content-type': type },
      body: body === undefined ? undefined : bytes ? body : JSON.stringify(body),
      signal: signal === undefined ? timeout : AbortSignal.any([timeout, signal]),
    });
  } catch (error) {
    if (signal?.aborted === true) throw error;
    throw new ApiError(words.noAnswer, 0);
  }
  if (!response.ok) throw await problem(response);
  return response;
}

/** The same for an answer in JSON. */
export async function requestJson<T>(url: string, method: Method, options: CallOptions = {}): Promise<T> {
  const response = await request(url, method, options);
  try {
    return (await response.json()) as T;
  } catch {
    throw new ApiError(words.unreadableAnswer, response.status);
  }
}

/** Words of an RFC 9457 problem, or of the bare status where the body is none. */
async function problem(response: Response): Promise<ApiError> {
  const body = (await response.json().catch(() => null)) as { title?: unknown; detail?: unknown } | null;
  const said = [body?.detail, body?.title].find((text): text is string => typeof text === 'string' && text !== '');
  return new ApiError(said ?? words.answeredWith(response.status), response.status);
}
