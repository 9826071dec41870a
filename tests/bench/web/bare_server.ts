import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { tmpdir } from 'node:os';
import { extname, join, normalize, resolve } from 'node:path';

import { build } from 'vite';
import WebSocket from 'ws';

const types: Record<string, string> = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '': 'application/octet-stream',
};

/** Serves the bare page on loopback, with what a session streamed. */
export class BareServer {
  private stream: Buffer = Buffer.alloc(0);
  private readonly folder = mkdtempSync(join(tmpdir(), 'ream-bare-page-'));
  private server: Server | null = null;
  url = '';

  async start(): Promise<void> {
    await build({
      root: resolve(import.meta.dirname, 'bare_page'),
      base: './',
      configFile: false,
      logLevel: 'error',
      build: { target: 'es2022', outDir: this.folder, emptyOutDir: true, chunkSizeWarningLimit: 2000 },
    });
    const server = createServer((request, response) => {
      const path = normalize(new URL(request.url ?? '/', 'http://bare').pathname);
      try {
        const body =
          path === '/stream' ? this.stream : readFileSync(join(this.folder, path === '/' ? 'index.html' : path));
        response.setHeader('content-type', types[path === '/' ? '.html' : extname(path)] ?? 'application/octet-stream');
        response.end(body);
      } catch {
        response.statusCode = 404;
        response.end();
      }
    });
    await new Promise<void>((listening) => server.listen(0, '127.0.0.1', listening));
    this.server = server;
    this.url = `http://127.0.0.1:${String((server.address() as AddressInfo).port)}/`;
  }

  /** From here on the page draws the bone that this stream tells of. */
  async show(streamUrl: string): Promise<void> {
    this.stream = await streamed(streamUrl);
  }

  dispose(): void {
    this.server?.close();
    this.server?.closeAllConnections();
    rmSync(this.folder, { recursive: true, force: true });
  }
}

/** Long enough for the whole picture. */
const listenMs = 4000;

/** All messages of the first seconds, each with its length (u32, little endian) before it. */
function streamed(url: string): Promise<Buffer> {
  return new Promise((heard, failed) => {
    const parts: Buffer[] = [];
    const socket = new WebSocket(url);
    socket.on('message', (message: Buffer) => {
      const length = Buffer.alloc(4);
      length.writeUInt32LE(message.length);
      parts.push(length, message);
    });
    socket.on('error', failed);
    setTimeout(() => {
      socket.close();
      heard(Buffer.concat(parts));
    }, listenMs);
  });
}
