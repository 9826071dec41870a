import { signal } from '@preact/signals';

/**
 * Carries a slider's positions to the server: one request at a time, and of what was wanted meanwhile only the newest.
 * Until the stream has caught up the wanted position is the one to show.
 */
export class Scrubber {
  /** Seconds of the recording; null when the stream's own position is to be shown. */
  readonly wantedS = signal<number | null>(null);
  private sending = false;
  private nextS: number | null = null;

  constructor(
    /** Goes to a position; rejects when the server does not. */
    private readonly send: (positionS: number) => Promise<unknown>,
    private readonly onProblem: (error: unknown) => void,
  ) {}

  seek(positionS: number): void {
    this.wantedS.value = positionS;
    this.nextS = positionS;
    if (!this.sending) void this.sendAll();
  }

  /** The stream has sent the position of the replay. */
  onStreamUpdate(): void {
    if (!this.sending) this.wantedS.value = null;
  }

  private async sendAll(): Promise<void> {
    this.sending = true;
    try {
      while (this.nextS !== null) {
        const positionS = this.nextS;
        this.nextS = null;
        await this.send(positionS);
      }
    } catch (error) {
      this.nextS = null;
      this.wantedS.value = null;
      this.onProblem(error);
    } finally {
      this.sending = false;
    }
  }
}
