/** Worker: owns the device's WebSocket and its beat, so that a page that is busy drawing does not hold up the hand. */
import type { DeviceWorkerReport, DeviceWorkerRequest } from './device_messages';
import { DeviceProtocol } from './device_protocol';

const beatMs = 12;
/** The page gets a report at most this often; what it shows changes no faster. */
const reportMs = 30;

// The DOM's typing of `self` is a window's.
const page = self as unknown as { postMessage(report: DeviceWorkerReport): void };

let socket: WebSocket | null = null;
let protocol: DeviceProtocol | null = null;
let beat: ReturnType<typeof setInterval> | undefined;

function drop(): void {
  clearInterval(beat);
  protocol = null;
  if (socket === null) return;
  socket.onopen = socket.onmessage = socket.onclose = null;
  socket.close();
  socket = null;
}

function open(connection: number, url: string): void {
  drop();
  const opened = new WebSocket(url);
  socket = opened;
  opened.binaryType = 'arraybuffer';
  const newProtocol = new DeviceProtocol(opened, () => performance.now(), performance.timeOrigin);
  opened.onopen = () => {
    protocol = newProtocol;
    newProtocol.greet();
    beat = setInterval(() => newProtocol.beat(), beatMs);
  };
  let reportedMs = -Infinity;
  opened.onmessage = (event: MessageEvent<ArrayBuffer>) => {
    try {
      const report = newProtocol.receive(new Uint8Array(event.data));
      const now = performance.now();
      if (report.kind === 'feedback' && now - reportedMs < reportMs) return;
      reportedMs = now;
      page.postMessage({ kind: 'report', connection, report });
    } catch (error) {
      drop();
      const reason = error instanceof Error ? error.message : String(error);
      page.postMessage({ kind: 'closed', connection, code: 0, reason });
    }
  };
  opened.onclose = (event) => {
    if (socket === opened) drop();
    page.postMessage({ kind: 'closed', connection, code: event.code, reason: event.reason });
  };
}

self.onmessage = (event: MessageEvent<DeviceWorkerRequest>) => {
  const request = event.data;
  if (request.kind === 'close') drop();
  else if (request.kind === 'open') open(request.connection, request.url);
  else protocol?.setInput(request.input);
};
