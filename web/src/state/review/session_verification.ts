import { signal } from '@preact/signals';

import type { Obstacle, Verification } from '../../twin/verification_worker';
import { messageOf } from '../../wire/rest';

export type VerificationState =
  | { kind: 'idle' }
  | { kind: 'preparing'; share: number }
  | { kind: 'computing'; ticks: number }
  | { kind: 'done'; verification: Verification }
  | { kind: 'impossible'; obstacle: Obstacle }
  /** The server made no file. */
  | { kind: 'refused'; reason: string };

export interface VerificationSources {
  /** Has the file of causes made; where it is, or itself. */
  causes(onProgress: (share: number) => void): Promise<string | Blob>;
  /** Rejects when it is given up. */
  verify(
    causes: string | Blob,
    onTicks: (ticks: number) => void,
    signal: AbortSignal,
  ): Promise<Verification | Obstacle>;
}

/** Whether a recorded session, computed again in this browser, leaves the bone that it says it left. */
export class SessionVerification {
  readonly state = signal<VerificationState>({ kind: 'idle' });
  private readonly abort = new AbortController();

  constructor(private readonly sources: VerificationSources) {}

  async run(): Promise<void> {
    const { kind } = this.state.peek();
    if (kind === 'preparing' || kind === 'computing') return;
    this.state.value = { kind: 'preparing', share: 0 };
    try {
      const causes = await this.sources.causes((share) => this.tell({ kind: 'preparing', share }));
      if (this.abort.signal.aborted) return;
      this.tell({ kind: 'computing', ticks: 0 });
      const onTicks = (ticks: number) => this.tell({ kind: 'computing', ticks });
      const found = await this.sources.verify(causes, onTicks, this.abort.signal);
      this.tell(
        typeof found === 'string' ? { kind: 'impossible', obstacle: found } : { kind: 'done', verification: found },
      );
    } catch (error) {
      this.tell({ kind: 'refused', reason: messageOf(error) });
    }
  }

  dispose(): void {
    this.abort.abort();
  }

  private tell(state: VerificationState): void {
    if (!this.abort.signal.aborted) this.state.value = state;
  }
}
