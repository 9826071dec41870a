import { decodeDeviceMessage, encodeHello, encodeSteering } from './device_codec';
import type { DeviceReport, SteeringInput } from './device_messages';

/** A page that has said nothing for this long is stuck: its input is no longer passed on. */
export const inputValidForMs = 400;
/** More than this waiting to be sent means a stuck link: what is sent later would come too late. */
const waitingBytesMax = 2048;
/** For so many inputs it is known when they were sent. */
const sentKept = 128;

/** Protocol of one device connection: greets, then sends the newest input at every beat. */
export class DeviceProtocol {
  private sequence = 0;
  private echoUs = 0n;
  private receivedMs = 0;
  private welcomed = false;
  private input: SteeringInput | null = null;
  private inputMs = 0;
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
  receive(bytes: Uint8Array): DeviceReport {
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
    this.receivedMs = this.nowMs();
  }

  setInput(input: SteeringInput): void {
    const before = this.input;
    this.input = input;
    this.inputMs = this.nowMs();
    // What takes force away is not left to the next beat.
    if (before !== null && ((before.held && !input.held) || (before.pushN > 0 && input.pushN <= 0))) this.beat();
  }

  /** To be called a hundred times a second or so. */
  beat(): void {
    if (!this.welcomed || this.input === null || this.socket.bufferedAmount > waitingBytesMax) return;
    const now = this.nowMs();
    const input = now - this.inputMs > inputValidForMs ? letGo(this.input) : this.input;
    const echoAgeUs = this.echoUs === 0n ? 0 : Math.round((now - this.receivedMs) * 1000);
    const sentUs = BigInt(Math.round(now * 1000));
    this.sentMs[(this.sequence + 1) % sentKept] = now;
    this.socket.send(encodeSteering(input, { sequence: ++this.sequence, sentUs, echoUs: this.echoUs, echoAgeUs }));
  }
}

/** The same place, but nobody pushes and nobody holds the tool. */
export function letGo(input: SteeringInput): SteeringInput {
  return { ...input, pushN: 0, spindleOn: false, held: false };
}
