import { problemText } from './problem_text';

export const { noAnswer } = problemText;

/** One thing wrong with a request, where the server names its place: "#/criteria/1/metric". */
export interface PlacedFault {
  pointer: string;
  detail: string;
}

/** What the server, or the way to it, answered instead of what was asked for; the message is for people. */
export class ApiError extends Error {
  constructor(
    message: string,
    /** HTTP status, 0 when there was no answer. */
    readonly status: number,
    /** The server asks not to try again before, s; null when it says nothing. */
    readonly retryAfterS: number | null = null,
    readonly faults: readonly PlacedFault[] = [],
  ) {
    super(message);
  }
}

export type Method = 'GET' | 'POST' | 'PUT' | 'PATCH' | 'DELETE';

// The first session of a fresh server waits until the demo case is made.
const timeoutMs: Record<Method, number> = { GET: 10000, POST: 60000, PUT: 60000, PATCH: 20000, DELETE: 10000 };

export interface CallOptions {
  /** Sent as JSON, or as bytes where it is an array of them. */
  body?: object | Uint8Array<ArrayBuffer>;
  signal?: AbortSignal;
  /** More headers, such as If-Match. */
  headers?: Record<string, string>;
  /** Where the usual time is too short for what the server has to do. */
  timeoutMs?: number;
  /** A refusal for want of a login is an answer here, and no end of the one there is. */
  quiet?: boolean;
}

/** Who asks, for all calls of this page. */
class Credentials {
  /** Proves that a change comes from this page and not from one that only has its cookie; null: none is needed. */
  csrfToken: string | null = null;
  /** Told that the login has ended. */
  onRefused: (() => void) | null = null;
  /** Asks for the token anew; true when it was another. */
  renew: (() => Promise<boolean>) | null = null;

  headers(): Record<string, string> {
    return this.csrfToken === null ? {} : { 'x-csrf-token': this.csrfToken };
  }
}

export const credentials = new Credentials();

/** One call of the REST interface; throws ApiError for anything but success, and AbortError when given up. */
export async function request(url: string, method: Method, options: CallOptions = {}): Promise<Response> {
  let response = await send(url, method, options);
  // Another window of this browser may have logged in anew meanwhile.
  if (response.status === 403 && method !== 'GET' && options.quiet !== true && (await credentials.renew?.()) === true)
    response = await send(url, method, options);
  if (response.ok) return response;
  const failure = await problem(response);
  if (response.status === 401 && options.quiet !== true) credentials.onRefused?.();
  throw failure;
}

async function send(url: string, method: Method, options: CallOptions): Promise<Response> {
  const { body, signal, headers } = options;
  const bytes = body instanceof Uint8Array;
  const type = bytes ? 'application/octet-stream' : 'application/json';
  const timeout = AbortSignal.timeout(options.timeoutMs ?? timeoutMs[method]);
  try {
    return await fetch(url, {
      method,
      cache: 'no-store',
      headers: {
        ...(body === undefined ? {} : { 'content-type': type }),
        ...(method === 'GET' ? {} : credentials.headers()),
        ...headers,
      },
      body: body === undefined ? undefined : bytes ? body : JSON.stringify(body),
      signal: signal === undefined ? timeout : AbortSignal.any([timeout, signal]),
    });
  } catch (error) {
    if (signal?.aborted === true) throw error;
    throw new ApiError(noAnswer, 0);
  }
}

/** The same for an answer in JSON. */
export async function requestJson<T>(url: string, method: Method, options: CallOptions = {}): Promise<T> {
  const response = await request(url, method, options);
  try {
    return (await response.json()) as T;
  } catch {
    throw new ApiError(problemText.unreadable, response.status);
  }
}

interface Problem {
  title?: unknown;
  detail?: unknown;
  errors?: unknown;
}

/** Words of an RFC 9457 problem, or of the bare status where the body is none. */
async function problem(response: Response): Promise<ApiError> {
  const body = (await response.json().catch(() => null)) as Problem | null;
  const message = [body?.detail, body?.title].find((text): text is string => typeof text === 'string' && text !== '');
  const wait = Number(response.headers.get('retry-after') ?? NaN);
  return new ApiError(
    message ?? problemText.status(response.status),
    response.status,
    Number.isFinite(wait) && wait > 0 ? wait : null,
    Array.isArray(body?.errors) ? (body.errors as PlacedFault[]) : [],
  );
}

/** Words for people of whatever was thrown. */
export function messageOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
