import { batch, computed, effect, type ReadonlySignal, signal, untracked } from '@preact/signals';

import type { InputKind } from '../practice/last_input';
import type { Practice } from './practice';
import type { PracticeStore } from './practice_store';
import type { Store } from './store';
import { advanced, type Astray, type StepName, stepNames, strayed } from './tutorial';
import { freshMemory, snapshotOf, type TutorialEye, type TutorialMemory } from './tutorial_snapshot';
import type { Watcher } from './watcher';

const demoCase = 'demo';
/** Full push of a first touch, and of reaming, N. */
const gentleN = 12;
const usualN = 52;
/** Where the reamer waits beside the plan, so that there is something to aim. */
const besideAtFirst = { superior: 5, anterior: 5 };

/** What of the picture it needs. */
interface TutorialView {
  eye(): TutorialEye;
  /** As the surgeon sees it, the plan in the middle. */
  reset(): void;
}

export interface TutorialParts {
  store: Store;
  practice: Pick<Practice, 'steer'>;
  practiceStore: PracticeStore;
  watcher: Pick<Watcher, 'practise' | 'reset'>;
  view: TutorialView;
}

/** Leads somebody through a first session on the demo, and remembers for each person whether that has been done. */
export class Tutorial {
  /** Its session; null: it is not under way. */
  readonly session = signal<string | null>(null);
  /** Index into the steps; their number when all are done. */
  readonly step = signal(0);
  readonly astray = signal<Astray | null>(null);
  readonly remembered = signal<'finished' | 'skipped' | null>(null);
  readonly stepName: ReadonlySignal<StepName | null> = computed(() => stepNames[this.step.value] ?? null);
  readonly input: ReadonlySignal<InputKind>;
  private memory: TutorialMemory | null = null;
  private levelBeforeN = usualN;
  private keep: (what: string) => void = () => undefined;

  constructor(private readonly parts: TutorialParts) {
    this.input = parts.practiceStore.input.kind;
    effect(() => this.follow());
  }

  /** Takes up what this person did with it in this browser. */
  keepFor(person: string, storage: Pick<Storage, 'getItem' | 'setItem'>): void {
    const key = `ream.tutorial.${person}`;
    const kept = storage.getItem(key);
    this.remembered.value = kept === 'finished' || kept === 'skipped' ? kept : null;
    this.keep = (what) => {
      try {
        storage.setItem(key, what);
      } catch {
        // A browser that keeps nothing offers it again.
      }
    };
  }

  /** A session of its own on the demo, from the first step on. */
  async start(): Promise<void> {
    this.levelBeforeN = this.parts.practiceStore.hand.levelN.peek();
    const id = await this.parts.watcher.practise(demoCase, false);
    if (id !== null) this.lead(id);
  }

  /** The same on intact bone, in another session. */
  async again(): Promise<void> {
    const id = await this.parts.watcher.reset();
    if (id !== null) this.lead(id);
  }

  /** Not wanted, or not any more; the reamer stays in the hand. */
  skip(): void {
    if (this.remembered.peek() !== 'finished') this.remember('skipped');
    this.close();
  }

  close(): void {
    if (this.session.peek() === null) return;
    this.parts.practiceStore.hand.setLevel(this.levelBeforeN);
    this.session.value = null;
  }

  private lead(id: string): void {
    this.memory = null;
    batch(() => {
      this.session.value = id;
      this.step.value = 0;
      this.astray.value = null;
    });
    if (this.parts.practiceStore.sessionId.peek() !== id) this.parts.practice.steer(id);
  }

  private follow(): void {
    const { store, practiceStore } = this.parts;
    const session = this.session.value;
    if (session === null) return;
    const watched = store.watched.value;
    if (watched !== null && watched.id !== session) {
      if (watched.reset_of !== session) return untracked(() => this.close());
      if (practiceStore.sessionId.value === watched.id) untracked(() => this.lead(watched.id));
      return;
    }
    if (this.memory === null && !this.begin(session)) return;
    this.judge(session);
  }

  /** Once the picture is there; whether it is. */
  private begin(session: string): boolean {
    const { store, practiceStore, view } = this.parts;
    const ready = practiceStore.plan.value !== null && store.pictureComplete.value;
    if (!ready || store.hello.value?.sessionId !== session) return false;
    untracked(() => {
      view.reset();
      practiceStore.hand.putAt(besideAtFirst, true);
      practiceStore.hand.setLevel(gentleN);
    });
    this.memory = freshMemory(view.eye());
    return true;
  }

  private judge(session: string): void {
    const { store, practiceStore, view } = this.parts;
    if (this.memory === null) return;
    const input = this.input.value;
    const now = snapshotOf(session, this.memory, { store, practice: practiceStore, input, eye: view.eye() });
    untracked(() => {
      const before = this.step.value;
      const after = advanced(before, now);
      batch(() => {
        this.step.value = after;
        this.astray.value = strayed(after, now);
      });
      if (after !== before) this.onStep(stepNames[before] ?? 'look');
    });
  }

  private onStep(done: StepName): void {
    const { hand } = this.parts.practiceStore;
    // Stays on the plan while the pointer goes to a button.
    if (done === 'aim') hand.putAt(hand.place.value, true);
    // A trigger says by itself how hard it presses.
    if (done === 'spindle') hand.setLevel(this.input.value === 'gamepad' ? usualN : gentleN);
    if (this.step.value === stepNames.length) this.remember('finished');
  }

  private remember(what: 'finished' | 'skipped'): void {
    this.remembered.value = what;
    this.keep(what);
  }
}
