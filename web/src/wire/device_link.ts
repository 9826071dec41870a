import { Backoff } from './backoff';
import { deviceProtocolRevision, type DeviceReport, type Feedback } from './device_messages';
import type { DeviceSocket } from './device_socket';

/**
 * - connecting: on its way
 * - holding: the server takes what the hand wants, and answers
 * - silent: connected, but the server has not answered for a while
 * - lost: no connection; the next attempt is at retryAtMs (null: under way now)
 * - ended: the server has said goodbye for good, in words: another page took over, or the session is over
 */
export type DeviceLinkState =
  | { kind: 'connecting' }
  | { kind: 'holding' }
  | { kind: 'silent' }
  | { kind: 'lost'; retryAtMs: number | null }
  | { kind: 'ended'; reason: string };

export interface DeviceLinkCallbacks {
  socket: DeviceSocket;
  onState(state: DeviceLinkState): void;
  onFeedback(feedback: Feedback): void;
}

/** Without an answer for this long the hand is not shown as holding. */
export const deviceSilentAfterMs = 700;
/** After this long the connection is given up. */
export const deviceLostAfterMs = 3000;
const catchUpMs = 50;

/** Keeps one device connection open: connects, notices loss and silence, and reconnects until it is closed. */
export class DeviceLink {
  private url: string | null = null;
  private state: DeviceLinkState = { kind: 'connecting' };
  private readonly backoff = new Backoff();
  private retryTimer: ReturnType<typeof setTimeout> | undefined;
  private silenceTimer: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly callbacks: DeviceLinkCallbacks) {}

  connect(url: string): void {
    this.disconnect();
    this.url = url;
    this.backoff.reset();
    this.set({ kind: 'connecting' });
    this.tryOnce();
  }

  disconnect(): void {
    this.stopTimers();
    this.url = null;
    this.callbacks.socket.close();
  }

  private tryOnce(): void {
    if (this.url === null) return;
    if (this.state.kind === 'lost') this.set({ kind: 'lost', retryAtMs: null });
    this.callbacks.socket.open(this.url, {
      onReport: (report) => this.receive(report),
      onClosed: (code, reason) => this.onClosed(code, reason),
    });
    this.silenceTimer = setTimeout(() => this.lose(), deviceLostAfterMs);
  }

  private receive(report: DeviceReport): void {
    if (report.kind === 'welcome') {
      if (report.welcome.protocolRevision !== deviceProtocolRevision) {
        this.end(`device protocol ${report.welcome.protocolRevision}, this page speaks ${deviceProtocolRevision}`);
        return;
      }
      this.backoff.reset();
    } else {
      if (this.state.kind !== 'holding') this.set({ kind: 'holding' });
      this.callbacks.onFeedback(report.feedback);
    }
    this.listen();
  }

  private listen(): void {
    clearTimeout(this.silenceTimer);
    this.silenceTimer = setTimeout(() => {
      // A page that was busy finds answers waiting behind this timer: they are heard first.
      this.silenceTimer = setTimeout(() => {
        this.set({ kind: 'silent' });
        this.silenceTimer = setTimeout(() => this.lose(), deviceLostAfterMs - deviceSilentAfterMs);
      }, catchUpMs);
    }, deviceSilentAfterMs);
  }

  /** Codes from 4000 on are the session's own: it does not want this client back. */
  private onClosed(code: number, reason: string): void {
    if (code >= 4000) this.end(reason);
    else this.lose();
  }

  private end(reason: string): void {
    this.disconnect();
    this.set({ kind: 'ended', reason });
  }

  private lose(): void {
    this.stopTimers();
    this.callbacks.socket.close();
    const pauseMs = this.backoff.take();
    this.set({ kind: 'lost', retryAtMs: Date.now() + pauseMs });
    this.retryTimer = setTimeout(() => this.tryOnce(), pauseMs);
  }

  private stopTimers(): void {
    clearTimeout(this.retryTimer);
    clearTimeout(this.silenceTimer);
  }

  private set(state: DeviceLinkState): void {
    this.state = state;
    this.callbacks.onState(state);
  }
}
