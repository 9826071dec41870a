import { existsSync, readFileSync } from 'node:fs';
import { createServer, type IncomingMessage, type ServerResponse } from 'node:http';
import type { AddressInfo } from 'node:net';
import { extname, join, normalize } from 'node:path';

import { WebSocketServer } from 'ws';

import { SessionState } from '../../../web/src/wire/generated/stream_generated';
import { FakeCaseServer } from '../fake_case/server';
import { FakeSession } from './session';

const types: Record<string, string> = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css' };

/** Serves REST, streams and the page in `webFolder` on loopback; gives the URL. Port 0 takes a free one. */
export async function serve(port: number, webFolder: string): Promise<string> {
  const sessions: FakeSession[] = [];
  const epoch = BigInt(Date.now());
  const caseServer = new FakeCaseServer();
  const server = createServer((request, response) => {
    if (caseServer.answer(request, response)) return;
    if (!answerApi(request, response, sessions, epoch)) answerFile(request, response, webFolder);
  });
  const sockets = new WebSocketServer({ noServer: true });
  server.on('upgrade', (request, socket, head) => {
    const [, id, what] = /^\/api\/v1\/sessions\/([^/]+)\/(stream|device)$/.exec(request.url ?? '') ?? [];
    const session = sessions.find((s) => s.id === id);
    if (session === undefined || (what === 'device' && session.hand === null)) {
      socket.end('HTTP/1.1 404 Not Found\r\n\r\n');
      return;
    }
    sockets.handleUpgrade(request, socket, head, (peer) =>
      what === 'device' ? session.hand?.take(peer) : session.join(peer),
    );
  });
  await new Promise<void>((resolve, reject) => {
    server.once('error', reject);
    server.listen(port, '127.0.0.1', resolve);
  });
  return `http://127.0.0.1:${(server.address() as AddressInfo).port}`;
}

/** False when the path is none of the interface's. */
function answerApi(
  request: IncomingMessage,
  response: ServerResponse,
  sessions: FakeSession[],
  epoch: bigint,
): boolean {
  const [, id, action] = /^\/api\/v1\/sessions(?:\/([^/]+)(?:\/([^/]+))?)?$/.exec(request.url ?? '') ?? [null];
  const call = `${request.method} ${action ?? (id === undefined ? 'all' : 'one')}`;
  if (!(request.url ?? '').startsWith('/api/v1/sessions')) return false;
  if (call === 'GET all') {
    json(response, 200, { sessions: sessions.map((s) => s.describe()).reverse(), replays: [] });
    return true;
  }
  if (call === 'POST all') {
    void readBody(request).then((body) => {
      const id = `fake${epoch % 100000n}n${sessions.length}`;
      const { device = 'script', case: caseId = 'demo' } = body as { device?: string; case?: string };
      const created = new FakeSession(id, 26, epoch, device, caseId);
      sessions.push(created);
      json(response, 201, created.describe());
    });
    return true;
  }
  const session = sessions.find((s) => s.id === id);
  if (session === undefined) problem(response, 404, `no session '${id}'`);
  else if (call === 'GET one') json(response, 200, session.describe());
  else if (call === 'GET metrics') json(response, 200, session.metrics());
  else if (call === 'POST start') changeState(response, session, SessionState.created, () => session.start());
  else if (call === 'POST stop')
    changeState(response, session, session.restingState(), () => session.end(SessionState.stopped));
  else problem(response, 405, `${call} is not known`);
  return true;
}

async function readBody(request: IncomingMessage): Promise<unknown> {
  let text = '';
  for await (const chunk of request) text += String(chunk);
  return text === '' ? {} : JSON.parse(text);
}

function changeState(response: ServerResponse, session: FakeSession, needed: SessionState, change: () => void): void {
  if (session.state !== needed) {
    problem(response, 409, `session '${session.id}' is ${SessionState[session.state]}`);
    return;
  }
  change();
  json(response, 200, session.describe());
}

function answerFile(request: IncomingMessage, response: ServerResponse, webFolder: string): void {
  const path = normalize(new URL(request.url ?? '/', 'http://localhost').pathname);
  const file = join(webFolder, path === '/' ? 'index.html' : path);
  if (!existsSync(file)) {
    problem(response, 404, `no file ${path}`);
    return;
  }
  response.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream' });
  response.end(readFileSync(file));
}

function json(response: ServerResponse, status: number, body: object): void {
  response.writeHead(status, { 'content-type': 'application/json' });
  response.end(JSON.stringify(body));
}

function problem(response: ServerResponse, status: number, detail: string): void {
  response.writeHead(status, { 'content-type': 'application/problem+json' });
  response.end(JSON.stringify({ type: 'about:blank', title: 'Refused', status, detail }));
}
