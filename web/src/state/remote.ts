import { batch, signal } from '@preact/signals';

import { wordsOf } from '../wire/rest';

/** Something that the server has, as it was last read, and what is done about it; problems are told in words. */
export class Remote<T> {
  readonly value = signal<T | null>(null);
  readonly problem = signal<string | null>(null);
  readonly busy = signal(false);
  private asked = 0;

  constructor(private readonly ask: () => Promise<T>) {}

  /** Of two readings at once the later one counts. */
  async read(): Promise<void> {
    const number = ++this.asked;
    try {
      const value = await this.ask();
      if (number !== this.asked) return;
      batch(() => {
        this.value.value = value;
        this.problem.value = null;
      });
    } catch (error) {
      if (number === this.asked) this.problem.value = wordsOf(error);
    }
  }

  /** Does something and reads anew; what it gives, or null when it failed. */
  async act<Result>(action: () => Promise<Result>): Promise<Result | null> {
    if (this.busy.value) return null;
    this.busy.value = true;
    try {
      const result = await action();
      await this.read();
      return result;
    } catch (error) {
      this.problem.value = wordsOf(error);
      return null;
    } finally {
      this.busy.value = false;
    }
  }
}
