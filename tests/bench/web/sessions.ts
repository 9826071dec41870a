const pause = (ms: number) => new Promise((done) => setTimeout(done, ms));

/** Sessions of a server, over REST as any client makes them. */
export class Sessions {
  constructor(private readonly serverUrl: string) {}

  /** Returns when the server can make sessions. */
  async ready(): Promise<void> {
    while (!(await fetch(new URL('/readyz', this.serverUrl))).ok) await pause(200);
  }

  /** A session that runs, of a script of the data folder. */
  async begin(caseName: string, script: string): Promise<string> {
    const { id } = (await this.request('POST', '', { case: caseName, script })) as { id: string };
    await this.request('POST', `/${id}/start`);
    return id;
  }

  /** Stops it, unless it has ended, and returns when it has. */
  async end(id: string): Promise<void> {
    if (!(await this.isRunning(id))) return;
    await this.request('POST', `/${id}/stop`);
    while (await this.isRunning(id)) await pause(100);
  }

  async isRunning(id: string): Promise<boolean> {
    return ((await this.request('GET', `/${id}`)) as { state: string }).state === 'running';
  }

  streamUrl(id: string): string {
    return `${this.serverUrl.replace(/^http/, 'ws').replace(/\/$/, '')}/api/v1/sessions/${id}/stream`;
  }

  private async request(method: string, path: string, body?: object): Promise<unknown> {
    const reply = await fetch(new URL(`/api/v1/sessions${path}`, this.serverUrl), {
      method,
      ...(body === undefined ? {} : { headers: { 'content-type': 'application/json' }, body: JSON.stringify(body) }),
    });
    const text = await reply.text();
    if (!reply.ok) throw new Error(`${method} /api/v1/sessions${path}: ${String(reply.status)} ${text}`);
    return text === '' ? null : JSON.parse(text);
  }
}
