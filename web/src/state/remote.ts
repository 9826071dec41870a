import { batch, signal } from '@preact/signals';

import { messageOf } from '../wire/rest';

/** Something that the server has, as it was last read, and what is done about it; problems are messages for people. */
export class Remote<T> {
  readonly value = signal<T | null>(null);
  /** What went wrong last; of a deed it stays until the next one, of a reading until one succeeds. */
  readonly problem = signal<string | null>(null);
  /** The last reading failed: `value` is an older one. */
  readonly stale = signal(false);
  readonly busy = signal(false);
  private requestNumber = 0;
  private actionFailed = false;

  constructor(private readonly load: () => Promise<T>) {}

  /** Of two readings at once the later one counts. */
  async read(): Promise<void> {
    const number = ++this.requestNumber;
    try {
      const value = await this.load();
      if (number !== this.requestNumber) return;
      batch(() => {
        this.value.value = value;
        this.stale.value = false;
        if (!this.actionFailed) this.problem.value = null;
      });
    } catch (error) {
      if (number === this.requestNumber) {
        this.fail(error, false);
        this.stale.value = true;
      }
    }
  }

  /** Does something and reads anew; what it gives, or null when it failed. */
  async act<Result>(action: () => Promise<Result>): Promise<Result | null> {
    if (this.busy.value) return null;
    this.busy.value = true;
    this.problem.value = null;
    this.actionFailed = false;
    try {
      const result = await action();
      await this.read();
      return result;
    } catch (error) {
      this.fail(error, true);
      return null;
    } finally {
      this.busy.value = false;
    }
  }

  private fail(error: unknown, action: boolean): void {
    this.problem.value = messageOf(error);
    this.actionFailed = action;
  }
}
