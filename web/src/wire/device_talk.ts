import { decodeDeviceMessage, encodeHello, encodeSteering } from './device_codec';
import type { DeviceReport, Wish } from './device_messages';

/** A page that has said nothing for this long is stuck: nobody's wish to push is passed on any more. */
export const wishGoodForMs = 400;
/** More than this waiting to be sent means a stuck link: what is sent later would come too late. */
const waitingBytesMax = 2048;
/** Of so many wishes it is known when they were sent. */
const sentKept = 128;

/** One connection's talk with the server: greets, then says the newest wish at every beat. */
export class DeviceTalk {
  private sequence = 0;
  private echoUs = 0n;
  private heardMs = 0;
  private welcomed = false;
  private wish: Wish | null = null;
  private wishedMs = 0;
  private readonly sentMs = new Float64Array(sentKept);

  /** `originMs`: what nowMs counts from, ms since 1970. */
  constructor(
    private readonly socket: { send(bytes: Uint8Array<ArrayBuffer>): void; readonly bufferedAmount: number },
    private readonly nowMs: () => number,
    private readonly originMs = 0,
  ) {}

  greet(): void {
    this.socket.send(encodeHello('page'));
  }

  /** Throws on a message that cannot be read. */
  hear(bytes: Uint8Array): DeviceReport {
    const report = decodeDeviceMessage(bytes);
    if (report.kind === 'welcome') this.welcomed = true;
    if (report.kind !== 'feedback') return report;
    this.echo(report.feedback.stampUs);
    return { kind: 'feedback', feedback: { ...report.feedback, sentMs: this.sentAtMs(report.feedback.sequence) } };
  }

  private sentAtMs(sequence: number): number | null {
    const known = sequence > 0 && sequence <= this.sequence && sequence > this.sequence - sentKept;
    return known ? this.originMs + (this.sentMs[sequence % sentKept] ?? 0) : null;
  }

  private echo(stampUs: bigint): void {
    this.echoUs = stampUs;
    this.heardMs = this.nowMs();
  }

  setWish(wish: Wish): void {
    const before = this.wish;
    this.wish = wish;
    this.wishedMs = this.nowMs();
    // What takes force away is not left to the next beat.
    if (before !== null && ((before.held && !wish.held) || (before.pushN > 0 && wish.pushN <= 0))) this.beat();
  }

  /** To be called a hundred times a second or so. */
  beat(): void {
    if (!this.welcomed || this.wish === null || this.socket.bufferedAmount > waitingBytesMax) return;
    const now = this.nowMs();
    const wish = now - this.wishedMs > wishGoodForMs ? letGo(this.wish) : this.wish;
    const echoAgeUs = this.echoUs === 0n ? 0 : Math.round((now - this.heardMs) * 1000);
    const sentUs = BigInt(Math.round(now * 1000));
    this.sentMs[(this.sequence + 1) % sentKept] = now;
    this.socket.send(encodeSteering(wish, { sequence: ++this.sequence, sentUs, echoUs: this.echoUs, echoAgeUs }));
  }
}

/** The same place, but nobody pushes and nobody holds the tool. */
export function letGo(wish: Wish): Wish {
  return { ...wish, pushN: 0, spindleOn: false, held: false };
}
