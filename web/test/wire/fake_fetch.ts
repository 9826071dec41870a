import { vi } from 'vitest';

export interface FakeRequest {
  method: string;
  path: string;
  headers: Record<string, string>;
  body: unknown;
}

/** Answers the page's calls in place of a server, and remembers them. */
export class FakeFetch {
  readonly requests: FakeRequest[] = [];

  constructor(private readonly answer: (requests: FakeRequest) => Response | Promise<Response>) {
    vi.stubGlobal('fetch', (url: string, init: RequestInit) => {
      const body = typeof init.body === 'string' ? (JSON.parse(init.body) as unknown) : undefined;
      const requests = {
        method: init.method ?? 'GET',
        path: new URL(url).pathname + new URL(url).search,
        headers: init.headers as Record<string, string>,
        body,
      };
      this.requests.push(requests);
      return Promise.resolve(this.answer(requests));
    });
  }
}

export const json = (status: number, body: object, headers: Record<string, string> = {}) =>
  new Response(JSON.stringify(body), { status, headers: { 'content-type': 'application/json', ...headers } });
export const problem = (status: number, detail: string, headers: Record<string, string> = {}) =>
  json(status, { type: 'about:blank', title: 'Refused', status, detail }, headers);
