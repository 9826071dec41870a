import type { StreamMessage, WorkerReport, WorkerRequest } from './messages';

export interface StreamHandlers {
  onMessage(message: StreamMessage): void;
  /** The connection ended or never came about; not called after `close` or another `open`. */
  onClosed(reason: string): void;
}

/** One stream connection at a time; opening another ends the one before, which is not heard of again. */
export interface StreamSocket {
  open(url: string, handlers: StreamHandlers): void;
  close(): void;
}

/** The stream as the worker delivers it. */
export class WorkerStreamSocket implements StreamSocket {
  private readonly worker = new Worker(new URL('./stream_worker.ts', import.meta.url), { type: 'module' });
  private connection = 0;
  private handlers: StreamHandlers | null = null;

  /** `simplifies`: whether surfaces come of fewer triangles, as drawing in software wants them (simplified_surface). */
  constructor(private readonly simplifies: boolean) {
    this.worker.onmessage = (event: MessageEvent<WorkerReport>) => {
      const report = event.data;
      if (report.connection !== this.connection || this.handlers === null) return;
      if (report.kind === 'message') {
        this.handlers.onMessage(report.message);
      } else {
        const handlers = this.handlers;
        this.handlers = null;
        handlers.onClosed(report.reason);
      }
    };
  }

  open(url: string, handlers: StreamHandlers): void {
    this.handlers = handlers;
    this.send({ kind: 'open', connection: ++this.connection, url, simplifies: this.simplifies });
  }

  close(): void {
    this.handlers = null;
    this.send({ kind: 'close' });
  }

  /** Nothing is opened any more. */
  dispose(): void {
    this.handlers = null;
    this.worker.terminate();
  }

  private send(request: WorkerRequest): void {
    this.worker.postMessage(request);
  }
}
