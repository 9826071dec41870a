import { expect, type Page } from '@playwright/test';

/** A call of the REST interface by the cookie of the page, as the page itself would make it; throws for a refusal. */
export const post = <T = { id: string }>(page: Page, path: string, body?: object) => call<T>(page, 'POST', path, body);
export const remove = (page: Page, path: string) => call<null>(page, 'DELETE', path);
export const patch = <T>(page: Page, path: string, body: object) => call<T>(page, 'PATCH', path, body);

/** Who has just sent name and password is known a moment later. */
async function untilKnown(page: Page): Promise<void> {
  const login = new URL('/api/v1/login', page.url()).href;
  const role = async () => ((await (await page.request.get(login)).json()) as { role: string | null }).role;
  await expect.poll(role, { timeout: 60_000 }).not.toBeNull();
}

async function call<T>(page: Page, method: string, path: string, body?: object): Promise<T> {
  await untilKnown(page);
  return (await page.evaluate(
    async ([method, to, data]) => {
      const visitor = (await (await fetch('/api/v1/login')).json()) as { csrf_token: string | null };
      const headers = { 'content-type': 'application/json', 'x-csrf-token': visitor.csrf_token ?? '' };
      const answer = await fetch(`/api/v1/${to}`, { method, headers, body: data && JSON.stringify(data) });
      if (!answer.ok) throw new Error(`${to}: ${answer.status} ${await answer.text()}`);
      return answer.status === 204 ? null : ((await answer.json()) as unknown);
    },
    [method, path, body] as const,
  )) as T;
}

/** A fresh server makes its demo case first. */
export async function untilReady(page: Page, serverUrl: string): Promise<void> {
  await expect.poll(async () => (await page.request.get(`${serverUrl}/readyz`)).ok(), { timeout: 120_000 }).toBe(true);
}

/** Until a session's loop has gone on by so many ms; it does also while the session is paused. */
export async function ticksPass(page: Page, session: string, ticks: number): Promise<void> {
  const url = new URL(`/api/v1/sessions/${session}`, page.url()).href;
  const tick = async () => ((await (await page.request.get(url)).json()) as { tick: number }).tick;
  const until = (await tick()) + ticks;
  await expect.poll(tick, { timeout: 60_000 }).toBeGreaterThanOrEqual(until);
}

/** Until the script of a session has come to its end. */
export async function untilFinished(page: Page, session: string): Promise<void> {
  const url = new URL(`/api/v1/sessions/${session}`, page.url()).href;
  const state = async () => ((await (await page.request.get(url)).json()) as { state: string }).state;
  await expect.poll(state, { timeout: 120_000 }).toBe('finished');
}

/** A session in which the scripted hand reams the demo; its id. */
export async function startDemo(page: Page, serverUrl: string): Promise<string> {
  await untilReady(page, serverUrl);
  const { id } = await post(page, 'sessions', { case: 'demo', script: 'demo', device: 'script' });
  await post(page, `sessions/${id}/start`);
  return id;
}
