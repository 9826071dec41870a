import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { ApiError, credentials, requestJson } from '../../src/wire/rest';
import { FakeFetch, json, problem } from './fake_fetch';

const base = 'http://here';
const failure = (call: Promise<unknown>) =>
  call.then(
    () => null,
    (error: unknown) => error as ApiError,
  );

describe('requests', () => {
  beforeEach(() => {
    credentials.csrfToken = null;
    credentials.onRefused = null;
    credentials.renew = null;
  });
  afterEach(() => vi.unstubAllGlobals());

  it('prove with every change that it comes from this page, and never say so when they only read', async () => {
    const server = new FakeFetch(() => json(200, {}));
    await requestJson(`${base}/a`, 'POST');
    credentials.csrfToken = 'proof';
    await requestJson(`${base}/a`, 'GET');
    for (const method of ['POST', 'PUT', 'PATCH', 'DELETE'] as const)
      await requestJson(`${base}/a`, method, { body: {} });
    expect(server.requests.map((requests) => requests.headers['x-csrf-token'])).toEqual([
      undefined,
      undefined,
      'proof',
      'proof',
      'proof',
      'proof',
    ]);
  });

  it('tell when the login has ended, but for those that ask who one is', async () => {
    new FakeFetch(() => problem(401, 'log in first'));
    let refusals = 0;
    credentials.onRefused = () => ++refusals;
    expect((await failure(requestJson(`${base}/a`, 'GET')))?.status).toBe(401);
    expect(refusals).toBe(1);
    await failure(requestJson(`${base}/a`, 'POST', { quiet: true }));
    expect(refusals).toBe(1);
  });

  it('are sent once more where the proof was of an earlier login', async () => {
    const server = new FakeFetch(({ headers }) =>
      headers['x-csrf-token'] === 'new' ? json(200, { done: true }) : problem(403, 'needs the header X-CSRF-Token'),
    );
    credentials.csrfToken = 'old';
    credentials.renew = () => {
      credentials.csrfToken = 'new';
      return Promise.resolve(true);
    };
    expect(await requestJson(`${base}/a`, 'POST')).toEqual({ done: true });
    expect(server.requests).toHaveLength(2);
    credentials.csrfToken = 'old';
    credentials.renew = () => Promise.resolve(false);
    expect((await failure(requestJson(`${base}/a`, 'POST')))?.status).toBe(403);
    expect(server.requests).toHaveLength(3);
  });

  it('say how long to wait before another try', async () => {
    new FakeFetch(() => problem(429, 'too many failed logins', { 'retry-after': '12' }));
    expect(await failure(requestJson(`${base}/a`, 'POST'))).toMatchObject({ status: 429, retryAfterS: 12 });
    new FakeFetch(() => problem(409, 'no'));
    expect(await failure(requestJson(`${base}/a`, 'POST'))).toMatchObject({ message: 'no', retryAfterS: null });
  });
});
