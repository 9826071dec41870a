import { createServer, connect, type AddressInfo, type Server, type Socket } from 'node:net';

/** Stands between the page and the server, so that a test can cut, refuse or hold the device's connection alone. */
export class CuttableProxy {
  private readonly server: Server;
  private readonly all = new Set<Socket>();
  private readonly device = new Set<Socket>();
  private refusing = false;
  url = '';

  constructor(private readonly serverUrl: string) {
    this.server = createServer((page) => this.pass(page));
  }

  async start(): Promise<void> {
    await new Promise<void>((resolve) => this.server.listen(0, '127.0.0.1', resolve));
    this.url = `http://127.0.0.1:${(this.server.address() as AddressInfo).port}`;
  }

  /** Ends the device's connections, and lets no new one through until `allowDevice`. */
  cutDevice(): void {
    this.refusing = true;
    for (const socket of this.device) socket.destroy();
  }

  allowDevice(): void {
    this.refusing = false;
  }

  /** While held, the device's connections stay open and nothing passes. */
  holdDevice(held: boolean): void {
    for (const socket of this.device) {
      if (held) socket.pause();
      else socket.resume();
    }
  }

  async dispose(): Promise<void> {
    for (const socket of this.all) socket.destroy();
    await new Promise((resolve) => this.server.close(resolve));
  }

  private pass(page: Socket): void {
    const { hostname, port } = new URL(this.serverUrl);
    const server = connect(Number(port), hostname);
    for (const [from, to] of [
      [page, server],
      [server, page],
    ] as const) {
      this.all.add(from);
      from.setNoDelay(true);
      from.on('error', () => to.destroy());
      from.on('close', () => {
        to.destroy();
        this.all.delete(from);
        this.device.delete(from);
      });
      from.on('end', () => to.end());
    }
    server.on('data', (bytes) => page.write(bytes));
    page.on('data', (bytes) => {
      if (/^GET \S+\/device /.test(bytes.subarray(0, 200).toString('latin1'))) {
        if (this.refusing) return page.destroy();
        this.device.add(page).add(server);
      }
      server.write(bytes);
    });
  }
}
