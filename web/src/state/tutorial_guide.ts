import { batch, computed, effect, type ReadonlySignal, signal, untracked } from '@preact/signals';

import type { InputKind } from '../practice/last_input';
import { usualThrustN } from './alarms';
import type { Practice } from './practice';
import { demoCase } from './practice_choice';
import type { PracticeStore } from './practice_store';
import type { Store } from './store';
import { advanced, type Astray, type StepName, stepNames, strayed } from './tutorial';
import { freshMemory, snapshotOf, type TutorialEye, type TutorialMemory } from './tutorial_snapshot';
import type { Watcher } from './watcher';

/** Full push of a first touch, N. */
const gentleN = 12;
/** Where the reamer waits beside the plan, so that there is something to aim. */
const besideAtFirst = { superior: 5, anterior: 5 };

/** What of the picture it needs. */
interface TutorialView {
  eye(): TutorialEye;
  /** As the surgeon sees it, the plan in the middle. */
  begin(): void;
  /** As the person had chosen it. */
  end(): void;
}

export interface TutorialParts {
  store: Store;
  practice: Pick<Practice, 'steer'>;
  practiceStore: PracticeStore;
  watcher: Pick<Watcher, 'practise' | 'reset' | 'stop'>;
  view: TutorialView;
}

/** Leads somebody through a first session on the demo, and remembers for each person whether that has been done. */
export class Tutorial {
  /** Its session; null: it is not under way. */
  readonly session = signal<string | null>(null);
  /** Index into the steps; their number when all are done. */
  readonly step = signal(0);
  readonly astray = signal<Astray | null>(null);
  /** The picture is there, and what is done in it counts. */
  readonly begun = signal(false);
  readonly remembered = signal<'finished' | 'skipped' | null>(null);
  readonly stepName: ReadonlySignal<StepName | null> = computed(() => stepNames[this.step.value] ?? null);
  readonly input: ReadonlySignal<InputKind>;
  private memory: TutorialMemory | null = null;
  /** A session is being made for it; what the page watches until then does not end it. */
  private readonly making = signal(false);
  private levelBeforeN = usualThrustN;
  private keep: (what: string) => void = () => undefined;

  constructor(private readonly parts: TutorialParts) {
    this.input = parts.practiceStore.input.kind;
    effect(() => this.follow());
  }

  /** Takes up what this person did with it in this browser. */
  keepFor(person: string, storage: Pick<Storage, 'getItem' | 'setItem'>): void {
    const key = `ream.tutorial.${person}`;
    let kept: string | null = null;
    try {
      kept = storage.getItem(key);
    } catch {
      // As if it had never been offered.
    }
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
    if (this.session.peek() === null) this.levelBeforeN = this.parts.practiceStore.hand.levelN.peek();
    await this.leadThrough(() => this.parts.watcher.practise(demoCase, false));
  }

  /** The same on intact bone, in another session; one that has ended, or is in another hand, is left as it is. */
  async again(): Promise<void> {
    if (!this.held()) return this.start();
    const { store, watcher } = this.parts;
    await this.leadThrough(async () => {
      const id = await watcher.reset();
      // Had the old one ended meanwhile, the new one waits for somebody to start it.
      const waits = id !== null && store.sessionState.peek() === 'created';
      return waits ? watcher.practise(demoCase, false) : id;
    });
  }

  /** Ends its session; no other, and none that is in another hand. */
  async stop(): Promise<void> {
    if (this.held()) await this.parts.watcher.stop();
  }

  /** Not wanted, or not any more; the reamer stays in the hand. */
  skip(): void {
    if (this.remembered.peek() !== 'finished') this.remember('skipped');
    this.close();
  }

  close(): void {
    if (this.session.peek() === null) return;
    this.parts.practiceStore.hand.setLevel(this.levelBeforeN);
    this.parts.view.end();
    this.session.value = null;
  }

  /** Its session is watched, and in the hand here. */
  private held(): boolean {
    const session = this.session.peek();
    const { store, practiceStore } = this.parts;
    return session !== null && store.sessionId.peek() === session && practiceStore.sessionId.peek() === session;
  }

  private async leadThrough(make: () => Promise<string | null>): Promise<void> {
    this.making.value = true;
    const id = await make();
    batch(() => {
      if (id !== null) this.lead(id);
      this.making.value = false;
    });
  }

  private lead(id: string): void {
    this.memory = null;
    batch(() => {
      this.session.value = id;
      this.step.value = 0;
      this.astray.value = null;
      this.begun.value = false;
      if (this.parts.practiceStore.sessionId.peek() !== id) this.parts.practice.steer(id, 'guided');
    });
  }

  private follow(): void {
    const { store, practiceStore } = this.parts;
    const session = this.session.value;
    if (session === null || this.making.value || store.replaying.value) return;
    const watched = store.watched.value;
    if (watched !== null && watched.id !== session) {
      if (watched.reset_of !== session) return untracked(() => this.close());
      if (practiceStore.sessionId.value === watched.id) untracked(() => this.lead(watched.id));
      return;
    }
    if (store.sessionId.value !== session) return;
    if (this.memory === null) this.begin(session);
    // Before the picture is there nothing can be done, but the session may end, or be in another hand.
    this.judge(session, this.memory ?? freshMemory(this.parts.view.eye()));
  }

  /** Once the picture is there. */
  private begin(session: string): void {
    const { store, practiceStore, view } = this.parts;
    const ready = practiceStore.plan.value !== null && store.pictureComplete.value;
    if (!ready || store.hello.value?.sessionId !== session) return;
    untracked(() => {
      view.begin();
      store.reamerShown.value = true;
      practiceStore.hand.putAt(besideAtFirst, true);
      practiceStore.hand.setLevel(gentleN);
      this.memory = freshMemory(view.eye());
      this.begun.value = true;
    });
  }

  private judge(session: string, memory: TutorialMemory): void {
    const { store, practiceStore, view } = this.parts;
    const input = this.input.value;
    const now = snapshotOf(session, memory, { store, practice: practiceStore, input, eye: view.eye() });
    untracked(() => {
      const before = this.step.value;
      const after = advanced(before, now);
      batch(() => {
        this.step.value = after;
        this.astray.value = strayed(after, now, this.astray.value);
      });
      if (after !== before) this.onStep(stepNames[before] ?? 'look');
    });
  }

  private onStep(done: StepName): void {
    const { hand } = this.parts.practiceStore;
    // Stays on the plan while the pointer goes to a button.
    if (done === 'aim') hand.putAt(hand.place.value, true);
    // A trigger says by itself how hard it presses.
    if (done === 'spindle') hand.setLevel(this.input.value === 'gamepad' ? usualThrustN : gentleN);
    if (this.step.value === stepNames.length) this.remember('finished');
  }

  private remember(what: 'finished' | 'skipped'): void {
    this.remembered.value = what;
    this.keep(what);
  }
}
