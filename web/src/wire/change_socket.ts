import { Backoff } from './backoff';

/** One text of /api/v1/events, as far as the page heeds it. */
export interface Change {
  /** hello, missed, session, replay, case, upload, job, user, study; more may come. */
  kind: string;
  number: number;
  /** Of what has changed. */
  id?: string;
  /** A state, or what was done. */
  change?: string;
}

export interface ChangeHandlers {
  onChange(change: Change): void;
  /** Nothing is heard until the next `hello`. */
  onLost(): void;
}

type Socket = Pick<WebSocket, 'close' | 'onmessage' | 'onclose'>;

/** What changes on the server, as it happens; connects again and again. Who listens reads anew at each hello. */
export class ChangeSocket {
  private socket: Socket | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private readonly backoff = new Backoff();
  private started = false;

  constructor(
    private readonly base: string,
    private readonly handlers: ChangeHandlers,
    private readonly open: (url: string) => Socket = (url) => new WebSocket(url),
  ) {}

  start(): void {
    if (this.started) return;
    this.started = true;
    this.connect();
  }

  stop(): void {
    this.started = false;
    clearTimeout(this.timer);
    this.leave();
    this.backoff.reset();
  }

  private connect(): void {
    const socket = this.open(`${this.base.replace(/^http/, 'ws')}/api/v1/events`);
    this.socket = socket;
    socket.onmessage = (event: MessageEvent<unknown>) => this.receive(event.data);
    socket.onclose = () => this.lose();
  }

  private receive(text: unknown): void {
    const change = changeIn(text);
    if (change === null) return;
    this.backoff.reset();
    this.handlers.onChange(change);
  }

  private lose(): void {
    this.leave();
    this.handlers.onLost();
    this.timer = setTimeout(() => this.connect(), this.backoff.take());
  }

  private leave(): void {
    if (this.socket === null) return;
    this.socket.onclose = null;
    this.socket.onmessage = null;
    this.socket.close();
    this.socket = null;
  }
}

/** Null for what is none. */
function changeIn(text: unknown): Change | null {
  try {
    const change = JSON.parse(String(text)) as Partial<Change> | null;
    return typeof change?.kind === 'string' && typeof change.number === 'number' ? (change as Change) : null;
  } catch {
    return null;
  }
}
