import { computed, signal } from '@preact/signals';

import { benchmarkText } from '../../text/benchmark_text';
import type { NewBenchmark } from '../../wire/rest_types';

export type Group = keyof typeof benchmarkText.groups;

/** Fewer make no pass mark. */
const minToContrast = 3;

/** A benchmark as it is being filled in. */
export class BenchmarkDraft {
  readonly name = signal('');
  readonly rubric = signal('standard');
  private readonly groups = signal<ReadonlyMap<string, Group>>(new Map());

  readonly experts = computed(() => this.of('expert'));
  readonly novices = computed(() => this.of('novice'));
  /** Why it cannot be made; null: it can. */
  readonly missing = computed(() => {
    const [experts, novices] = [this.experts.value.length, this.novices.value.length];
    if (experts === 0) return benchmarkText.needExpert;
    return novices > 0 && Math.min(experts, novices) < minToContrast ? benchmarkText.needThree : null;
  });

  groupOf(session: string): Group {
    return this.groups.value.get(session) ?? 'none';
  }
  put(session: string, group: Group): void {
    this.groups.value = new Map([...this.groups.value, [session, group]]);
  }
  clear(): void {
    this.name.value = '';
    this.groups.value = new Map();
  }

  /** What the server is asked for. */
  benchmark(): NewBenchmark {
    const [experts, novices] = [this.experts.value, this.novices.value];
    return {
      name: this.name.value.trim(),
      experts,
      ...(novices.length === 0 ? {} : { novices, rubric: this.rubric.value }),
    };
  }

  private of(group: Group): string[] {
    return [...this.groups.value].filter(([, one]) => one === group).map(([session]) => session);
  }
}
