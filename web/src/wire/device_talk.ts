import { decodeDeviceMessage, encodeHello, encodeSteering } from './device_codec';
import type { DeviceReport, Wish } from './device_messages';

/** A page that has said nothing for this long is stuck: nobody's wish to push is passed on any more. */
export const wishGoodForMs = 400;
/** More than this waiting to be sent means a stuck link: what is sent later would come too late. */
const waitingBytesMax = 2048;

/** One connection's talk with the server: greets, then says the newest wish at every beat. */
export class DeviceTalk {
  private sequence = 0;
  private echoUs = 0n;
  private welcomed = false;
  private wish: Wish | null = null;
  private wishedMs = 0;

  constructor(
    private readonly socket: { send(bytes: Uint8Array<ArrayBuffer>): void; readonly bufferedAmount: number },
    private readonly nowMs: () => number,
  ) {}

  greet(): void {
    this.socket.send(encodeHello('page'));
  }

  /** Throws on a message that cannot be read. */
  hear(bytes: Uint8Array): DeviceReport {
    const report = decodeDeviceMessage(bytes);
    if (report.kind === 'welcome') this.welcomed = true;
    else this.echoUs = report.feedback.stampUs;
    return report;
  }

  setWish(wish: Wish): void {
    this.wish = wish;
    this.wishedMs = this.nowMs();
    // What takes force away is not left to the next beat.
    if (!wish.held || wish.pushN <= 0) this.beat();
  }

  /** To be called a hundred times a second or so. */
  beat(): void {
    if (!this.welcomed || this.wish === null || this.socket.bufferedAmount > waitingBytesMax) return;
    const now = this.nowMs();
    const wish = now - this.wishedMs > wishGoodForMs ? letGo(this.wish) : this.wish;
    this.socket.send(encodeSteering(wish, ++this.sequence, BigInt(Math.round(now * 1000)), this.echoUs));
  }
}

/** The same place, but nobody pushes and nobody holds the tool. */
export function letGo(wish: Wish): Wish {
  return { ...wish, pushN: 0, spindleOn: false, held: false };
}
