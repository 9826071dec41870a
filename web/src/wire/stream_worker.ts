/** Worker: owns the WebSocket, decodes its messages off the page's thread and passes them on. */
import { StreamDecoder, transferables } from './decode';
import { meshDecoderReady } from './decode_block';
import type { StreamMessage, WorkerReport, WorkerRequest } from './messages';
import type { SurfaceSimplifier } from './surface_simplifier';

// The DOM's typing of `self` is a window's; a worker's postMessage takes the transfer list in second place.
const page = self as unknown as { postMessage(report: WorkerReport, transfer: ArrayBuffer[]): void };

/** So long work may keep what comes from being passed on, ms. */
const sliceMs = 8;

type OpenRequest = Extract<WorkerRequest, { kind: 'open' }>;

let socket: WebSocket | null = null;
/** The newest request, while it is to be opened or is open. */
let wanted: OpenRequest | null = null;

/** What is done in the next turn, after what has come meanwhile. (Timers that follow each other wait some milliseconds each.) */
let nextTurn: (() => void) | null = null;
const turns = new MessageChannel();
turns.port1.onmessage = () => {
  const work = nextTurn;
  nextTurn = null;
  work?.();
};

function betweenMessages(work: () => void): void {
  nextTurn = work;
  turns.port2.postMessage(null);
}

function drop(): void {
  if (socket === null) return;
  socket.onmessage = null;
  socket.onclose = null;
  socket.close();
  socket = null;
}

function open({ connection, url }: OpenRequest, Simplifier: typeof SurfaceSimplifier | null): void {
  const decoder = new StreamDecoder(Simplifier);
  const opened = new WebSocket(url);
  socket = opened;
  const pass = (message: StreamMessage) =>
    page.postMessage({ kind: 'message', connection, message }, transferables(message));
  const goOn = () => {
    if (socket !== opened) return;
    const simpler = decoder.goOn(sliceMs);
    if (simpler !== null) pass(simpler);
    else if (decoder.works) betweenMessages(goOn);
  };
  opened.binaryType = 'arraybuffer';
  opened.onmessage = (event: MessageEvent<ArrayBuffer>) => {
    try {
      const receivedMs = performance.timeOrigin + performance.now();
      const message = decoder.decode(new Uint8Array(event.data));
      if (message.kind === 'telemetry') message.telemetry.receivedMs = receivedMs;
      pass(message);
      if (message.kind === 'mesh' && message.mesh.simplerFollow === true) betweenMessages(goOn);
    } catch (error) {
      drop();
      const reason = `unreadable message: ${error instanceof Error ? error.message : String(error)}`;
      page.postMessage({ kind: 'closed', connection, reason }, []);
    }
  };
  opened.onclose = (event) => {
    if (socket === opened) socket = null;
    page.postMessage({ kind: 'closed', connection, reason: event.reason }, []);
  };
}

/** Only where it is wanted, as it is larger than this worker; null where it cannot be had: the bone is seen all the same. */
async function loadSimplifier(): Promise<typeof SurfaceSimplifier | null> {
  try {
    const { simplifierReady, SurfaceSimplifier } = await import('./surface_simplifier');
    await simplifierReady;
    return SurfaceSimplifier;
  } catch {
    return null;
  }
}

async function openWhenReady(request: OpenRequest): Promise<void> {
  const { connection } = request;
  try {
    await meshDecoderReady;
    const Simplifier = request.simplifies ? await loadSimplifier() : null;
    if (wanted === request) open(request, Simplifier);
  } catch (error) {
    const reason = `this browser cannot read the stream: ${error instanceof Error ? error.message : String(error)}`;
    if (wanted === request) page.postMessage({ kind: 'closed', connection, reason }, []);
  }
}

self.onmessage = (event: MessageEvent<WorkerRequest>) => {
  const request = event.data;
  drop();
  wanted = request.kind === 'open' ? request : null;
  if (request.kind === 'open') void openWhenReady(request);
};
