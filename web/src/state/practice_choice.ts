import { batch, computed, effect, type ReadonlySignal, type Signal, signal } from '@preact/signals';

import { isLevelName, type LevelName, levels } from '../practice/level';
import type { Case, CaseSummary, Reamer } from '../wire/rest_types';
import type { Practice } from './practice';
import type { Watcher } from './watcher';

/** Always there, also while the server still prepares it. */
export const demoCase = 'demo';

interface Cases {
  cases(): Promise<CaseSummary[]>;
  case(id: string): Promise<Pick<Case, 'plan'>>;
  reamers(): Promise<Reamer[]>;
}

export interface CaseOption {
  id: string;
  name: string;
}

/** What a plan says of its reamer: one that is known by a name and its size, or in the plan's own words. */
export type PlannedReamer = Pick<Reamer, 'name' | 'diameter_mm'> | string;

const isReady = (one: CaseSummary): boolean => one.stage === 'built' && one.planned;

/** The case and the level of one's next practice, kept on this computer for each person that uses it. */
export class PracticeChoice {
  readonly level = signal<LevelName>('guided');
  /** Cases with bone and plan; null: not known, or not for this person. */
  readonly cases = signal<readonly CaseOption[] | null>(null);
  /** The one to practise on: the last one, for as long as it can be reamed. */
  readonly caseId: ReadonlySignal<string>;
  /** Of the chosen case's plan; null while it is not known. */
  readonly reamer = signal<PlannedReamer | null>(null);
  private readonly last = signal(demoCase);
  private reamers: readonly Reamer[] | null = null;

  constructor(
    private readonly api: Cases,
    private readonly mayRead: () => boolean,
  ) {
    this.caseId = computed(() => {
      const known = this.cases.value;
      const there = known === null || known.some(({ id }) => id === this.last.value);
      return mayRead() && there ? this.last.value : demoCase;
    });
  }

  choose(caseId: string): void {
    this.last.value = caseId;
  }

  /** What can be chosen now; a failure leaves what was known. */
  async read(): Promise<void> {
    if (!this.mayRead()) return;
    const all = await this.api.cases().catch(() => null);
    if (all === null) return;
    const ready = all.filter((one) => isReady(one) || one.id === demoCase);
    const named = ready.map(({ id, name }) => ({ id, name: name || id }));
    const demo = named.find(({ id }) => id === demoCase) ?? { id: demoCase, name: demoCase };
    this.cases.value = [demo, ...named.filter(({ id }) => id !== demoCase)];
  }

  /** Reads the reamer of the chosen case, whenever that is another one; until the result is called. */
  followReamer(): () => void {
    // Null for a case that the list does not have yet: it cannot be read either. A list read again changes nothing.
    const readable = computed(() => this.cases.value?.find(({ id }) => id === this.caseId.value)?.id ?? null);
    return effect(() => {
      const id = readable.value;
      this.reamer.value = null;
      if (id !== null) void this.readReamer(id);
    });
  }

  private async readReamer(id: string): Promise<void> {
    try {
      const { plan } = await this.api.case(id);
      this.reamers ??= await this.api.reamers();
      if (id !== this.caseId.peek() || plan === null) return;
      const known = this.reamers.find(({ name, words }) => words === plan.reamer || name === plan.reamer);
      this.reamer.value = known ?? plan.reamer;
    } catch {
      // Practice needs no words about the reamer.
    }
  }

  /** Takes up what this person chose last and keeps what is chosen from here on, until the result is called. */
  keepFor(person: string, storage: Pick<Storage, 'getItem' | 'setItem'>): () => void {
    const key = `ream.practice.${person}`;
    const kept = keptChoice(storage, key);
    batch(() => {
      this.level.value = kept.level;
      this.last.value = kept.caseId;
    });
    return effect(() => {
      const choice = JSON.stringify({ level: this.level.value, caseId: this.last.value });
      try {
        storage.setItem(key, choice);
      } catch {
        // A browser that keeps nothing still practises as chosen.
      }
    });
  }
}

function keptChoice(storage: Pick<Storage, 'getItem'>, key: string): { level: LevelName; caseId: string } {
  try {
    const kept = JSON.parse(storage.getItem(key) ?? '{}') as { level?: unknown; caseId?: unknown } | null;
    return {
      level: isLevelName(kept?.level) ? kept.level : 'guided',
      caseId: typeof kept?.caseId === 'string' && kept.caseId !== '' ? kept.caseId : demoCase,
    };
  } catch {
    return { level: 'guided', caseId: demoCase };
  }
}

/** The way from a case into a session on it. */
export interface Reaming {
  level: Signal<LevelName>;
  /** Makes a session on the case and shows it; throws an Error with words. */
  start(caseId: string): Promise<void>;
}

interface Means {
  watcher: Pick<Watcher, 'practise'>;
  practice: Pick<Practice, 'steer'>;
  choice: Pick<PracticeChoice, 'caseId' | 'level' | 'choose'>;
}

/**
 * Makes a session at the chosen level, on the chosen case or the one that is given, and takes the reamer into the hand;
 * its id, or null when that failed.
 */
export async function beginPractice({ watcher, practice, choice }: Means, caseId?: string): Promise<string | null> {
  const level = choice.level.peek();
  const wanted = caseId ?? choice.caseId.peek();
  const id = await watcher.practise(wanted, levels[level].theatre);
  if (id === null) return null;
  choice.choose(wanted);
  practice.steer(id, level);
  return id;
}
