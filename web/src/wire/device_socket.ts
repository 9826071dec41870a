import type { DeviceReport, DeviceWorkerReport, DeviceWorkerRequest, SteeringInput } from './device_messages';

export interface DeviceHandlers {
  onReport(report: DeviceReport): void;
  /** The connection ended or never came about; not called after `close` or another `open`. */
  onClosed(code: number, reason: string): void;
}

/** One device connection at a time; opening another ends the one before, which is not heard of again. */
export interface DeviceSocket {
  open(url: string, handlers: DeviceHandlers): void;
  /** The newest input is sent again and again, until there is a newer one. */
  steer(input: SteeringInput): void;
  close(): void;
}

/** The device connection as the worker keeps it; the worker is made when it is first needed. */
export class WorkerDeviceSocket implements DeviceSocket {
  private worker: Worker | null = null;
  private connection = 0;
  private handlers: DeviceHandlers | null = null;

  open(url: string, handlers: DeviceHandlers): void {
    this.handlers = handlers;
    this.worker ??= this.create();
    this.send({ kind: 'open', connection: ++this.connection, url });
  }

  steer(input: SteeringInput): void {
    this.send({ kind: 'steer', input });
  }

  close(): void {
    this.handlers = null;
    this.send({ kind: 'close' });
  }

  private create(): Worker {
    const worker = new Worker(new URL('./device_worker.ts', import.meta.url), { type: 'module' });
    worker.onmessage = (event: MessageEvent<DeviceWorkerReport>) => {
      const message = event.data;
      const handlers = this.handlers;
      if (message.connection !== this.connection || handlers === null) return;
      if (message.kind === 'report') {
        handlers.onReport(message.report);
      } else {
        this.handlers = null;
        handlers.onClosed(message.code, message.reason);
      }
    };
    return worker;
  }

  private send(request: DeviceWorkerRequest): void {
    this.worker?.postMessage(request);
  }
}
