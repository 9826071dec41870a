import { Backoff } from './backoff';
import { protocolRevision, type StreamMessage } from './messages';
import { messageOf } from './rest';
import type { StreamSocket } from './stream_socket';
import { problemText } from './problem_text';

/**
 * - connecting: nothing was lost yet, a first picture is on its way
 * - live: messages arrive as they should
 * - silent: connected, but a running session has sent nothing for a while
 * - lost: no connection; the next attempt is at retryAtMs (null: under way now)
 * - nothing: the server answers, but there is no session to see yet; it is looked for again and again
 * - refused: the server speaks another revision; trying again would not help
 */
export type LinkState =
  | { kind: 'connecting' }
  | { kind: 'live' }
  | { kind: 'silent'; sinceMs: number }
  | { kind: 'nothing' }
  | { kind: 'lost'; sinceMs: number; retryAtMs: number | null; reason: string }
  | { kind: 'refused'; serverRevision: number };

export interface LinkCallbacks {
  socket: StreamSocket;
  /** Finds the session to watch and gives its stream's address, null where there is none; asked for each attempt. */
  findStream(): Promise<string | null>;
  onState(state: LinkState): void;
  onMessage(message: StreamMessage): void;
}

/** A running session that says nothing for this long is not shown as live. */
export const silentAfterMs = 1200;
/** After this long the connection is given up. */
export const lostAfterSilenceMs = 5000;
/** Where there was no session to see, one is looked for again after this time. */
export const lookAgainMs = 2500;
/** A connection that has not said hello by then is given up. */
export const helloWithinMs = 5000;

/** Keeps one stream open: connects, notices loss and silence, and tries again, for ever. */
export class Link {
  private state: LinkState = { kind: 'connecting' };
  private readonly backoff = new Backoff();
  private attempt = 0;
  private retryTimer: ReturnType<typeof setTimeout> | undefined;
  private silenceTimer: ReturnType<typeof setTimeout> | undefined;
  private lastMessageMs = 0;
  private trafficExpected = false;

  constructor(private readonly callbacks: LinkCallbacks) {}

  /** Connects, or leaves the present stream for the one that findStream names now. */
  connect(): void {
    this.stopTimers();
    this.callbacks.socket.close();
    void this.tryOnce(++this.attempt);
  }

  /** Ends the stream; nothing counts as live until `connect`. */
  stop(): void {
    this.stopTimers();
    ++this.attempt;
    this.callbacks.socket.close();
    this.set({ kind: 'connecting' });
  }

  /** The connection is open, but it is known otherwise that nobody answers at its other end. */
  giveUp(reason: string): void {
    if (this.state.kind === 'live' || this.state.kind === 'silent') this.lose(reason);
  }

  /** Whether the session is one that sends all the time (running), so that silence means trouble. */
  expectTraffic(expected: boolean): void {
    if (expected === this.trafficExpected) return;
    this.trafficExpected = expected;
    if (this.state.kind === 'live' || this.state.kind === 'silent') {
      this.set({ kind: 'live' });
      this.listen();
    }
  }

  private async tryOnce(attempt: number): Promise<void> {
    if (this.state.kind === 'lost') this.set({ ...this.state, retryAtMs: null });
    try {
      const url = await this.callbacks.findStream();
      if (attempt !== this.attempt) return;
      if (url === null) {
        this.backoff.reset();
        this.set({ kind: 'nothing' });
        this.retryTimer = setTimeout(() => void this.tryOnce(attempt), lookAgainMs);
        return;
      }
      this.silenceTimer = setTimeout(() => this.lose(problemText.noHello), helloWithinMs);
      this.callbacks.socket.open(url, {
        onMessage: (message) => this.receive(message),
        onClosed: (reason) => this.lose(reason),
      });
    } catch (error) {
      if (attempt === this.attempt) this.lose(messageOf(error));
    }
  }

  private receive(message: StreamMessage): void {
    // No sign of life of the server.
    if (message.kind === 'simpler') return this.callbacks.onMessage(message);
    if (message.kind === 'hello') {
      if (message.hello.protocolRevision !== protocolRevision) {
        this.stop();
        this.set({ kind: 'refused', serverRevision: message.hello.protocolRevision });
        return;
      }
      this.backoff.reset();
    }
    this.lastMessageMs = Date.now();
    if (this.state.kind !== 'live') this.set({ kind: 'live' });
    this.listen();
    this.callbacks.onMessage(message);
  }

  private listen(): void {
    clearTimeout(this.silenceTimer);
    if (!this.trafficExpected) return;
    this.silenceTimer = setTimeout(() => {
      this.set({ kind: 'silent', sinceMs: this.lastMessageMs });
      this.silenceTimer = setTimeout(() => this.lose(''), lostAfterSilenceMs - silentAfterMs);
    }, silentAfterMs);
  }

  private lose(reason: string): void {
    this.stopTimers();
    const attempt = ++this.attempt;
    this.callbacks.socket.close();
    const pauseMs = this.backoff.take();
    const sinceMs = this.state.kind === 'lost' || this.state.kind === 'silent' ? this.state.sinceMs : Date.now();
    this.set({ kind: 'lost', sinceMs, retryAtMs: Date.now() + pauseMs, reason });
    this.retryTimer = setTimeout(() => void this.tryOnce(attempt), pauseMs);
  }

  private stopTimers(): void {
    clearTimeout(this.retryTimer);
    clearTimeout(this.silenceTimer);
  }

  private set(state: LinkState): void {
    this.state = state;
    this.callbacks.onState(state);
  }
}
