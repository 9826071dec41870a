import type { StreamHandlers, StreamSocket } from '../../src/wire/stream_socket';

/** A socket that the test plays the server of. */
export class FakeSocket implements StreamSocket {
  readonly opened: string[] = [];
  handlers: StreamHandlers | null = null;

  open(url: string, handlers: StreamHandlers): void {
    this.opened.push(url);
    this.handlers = handlers;
  }
  close(): void {
    this.handlers = null;
  }
  /** The far end goes away. */
  end(reason = ''): void {
    const handlers = this.handlers;
    this.handlers = null;
    handlers?.onClosed(reason);
  }
}
