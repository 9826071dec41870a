import { createServer, connect, type AddressInfo, type Server, type Socket } from 'node:net';

const stepMs = 20;

/** Stands between the page and the server as a slow line does: so many bits a second to the page, for all connections. */
export class SlowProxy {
  private readonly server: Server;
  private readonly sockets = new Set<Socket>();
  private readonly waiting: { page: Socket; server: Socket; bytes: Buffer }[] = [];
  private readonly timer: ReturnType<typeof setInterval>;
  private credit = 0;
  private lastMs = performance.now();
  url = '';

  constructor(
    private readonly serverUrl: string,
    public bitsPerSecond: number,
  ) {
    this.server = createServer((page) => this.pass(page));
    this.timer = setInterval(() => this.step(), stepMs);
  }

  async start(): Promise<void> {
    await new Promise<void>((resolve) => this.server.listen(0, '127.0.0.1', resolve));
    this.url = `http://127.0.0.1:${(this.server.address() as AddressInfo).port}`;
  }

  async dispose(): Promise<void> {
    clearInterval(this.timer);
    for (const socket of this.sockets) socket.destroy();
    await new Promise((resolve) => this.server.close(resolve));
  }

  /** What has come from the server goes on in turn; a connection whose bytes wait takes no more from it. */
  private step(): void {
    const nowMs = performance.now();
    const earned = (this.bitsPerSecond / 8) * ((nowMs - this.lastMs) / 1000);
    this.credit = Math.min(this.credit + earned, (this.bitsPerSecond / 8) * 0.1);
    this.lastMs = nowMs;
    for (let next = this.waiting.shift(); next !== undefined; next = this.waiting.shift()) {
      const now = next.bytes.subarray(0, Math.floor(this.credit));
      if (now.length > 0) next.page.write(now);
      this.credit -= now.length;
      const later = next.bytes.subarray(now.length);
      if (later.length > 0) {
        this.waiting.unshift({ ...next, bytes: later });
        return;
      }
      next.server.resume();
    }
  }

  private pass(page: Socket): void {
    const { hostname, port } = new URL(this.serverUrl);
    // Read in small pieces, so that little waits here.
    const onread = {
      buffer: Buffer.alloc(4096),
      callback: (count: number, buffer: Uint8Array) => {
        server.pause();
        this.waiting.push({ page, server, bytes: Buffer.from(buffer.subarray(0, count)) });
        return true;
      },
    };
    const server: Socket = connect({ port: Number(port), host: hostname, onread });
    for (const [from, to] of [
      [page, server],
      [server, page],
    ] as const) {
      this.sockets.add(from);
      from.setNoDelay(true);
      from.on('error', () => to.destroy());
      from.on('close', () => {
        to.destroy();
        this.sockets.delete(from);
      });
    }
    page.on('data', (bytes) => server.write(bytes));
  }
}
