import { batch, effect } from '@preact/signals';

import { GamepadHand } from '../practice/gamepad_hand';
import { KeyHand } from '../practice/key_hand';
import { levelOf, type LevelName, levels } from '../practice/level';
import { PointerHand, type SteeredView } from '../practice/pointer_hand';
import { Rumble } from '../practice/rumble';
import { randomOf, startPose } from '../practice/start_pose';
import { DeviceLink, type DeviceLinkState } from '../wire/device_link';
import type { DeviceSocket } from '../wire/device_socket';
import { appText } from '../text/app_text';
import type { Session } from '../wire/rest_types';
import { LevelMemory } from './level_memory';
import type { PracticeStore } from './practice_store';
import type { Store } from './store';

const stepMs = 16;
/** A page that was held up does not make up for it in one step. */
const longestStepS = 0.1;
/** Kept over a reload of the page, so that the hand comes back to its session. */
const rememberedKey = 'ream.steered';

/** What the practice asks of the browser's window. */
export interface PracticeWindow {
  /** The page is seen and has the keys. */
  attended(): boolean;
  gamepad(): Gamepad | null;
  nowMs(): number;
  remembered: Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>;
}

/** Steers one session with mouse, touch, keys and gamepad: sends the hand's input and keeps the device connection. */
export class Practice {
  private readonly link: DeviceLink;
  private readonly keys: KeyHand;
  private readonly pad: GamepadHand;
  private readonly rumble = new Rumble();
  private timer: ReturnType<typeof setInterval> | undefined;
  private steppedMs = 0;
  private readonly levels: LevelMemory;

  constructor(
    private readonly practice: PracticeStore,
    private readonly store: Store,
    private readonly socket: DeviceSocket,
    surface: HTMLElement,
    private readonly view: SteeredView,
    private readonly window: PracticeWindow,
    private readonly deviceUrl: (sessionId: string) => string,
  ) {
    this.link = new DeviceLink({
      socket,
      onState: (state) => this.onLink(state),
      onFeedback: (feedback) => {
        practice.feedback.value = feedback;
        this.rumble.feel(feedback.vibrationG);
      },
    });
    this.levels = new LevelMemory(window.remembered);
    const plan = () => practice.plan.value;
    new PointerHand(surface, practice.hand, view, plan);
    this.keys = new KeyHand(surface, practice.hand, view, plan);
    this.pad = new GamepadHand(practice.hand);
    effect(() => {
      if (practice.sessionId.value === null) return;
      const elsewhere = practice.sessionId.value !== store.sessionId.value;
      const state = store.sessionState.value;
      if (elsewhere || (state !== null && state !== 'created' && !store.active.value)) this.leave();
    });
  }

  private onLink(state: DeviceLinkState): void {
    batch(() => {
      this.practice.link.value = state;
      if (state.kind !== 'holding') this.practice.feedback.value = null;
      // What was pressed when the connection went is pressed anew.
      if (state.kind === 'lost') this.practice.hand.letGo();
      if (state.kind === 'ended') {
        this.leave();
        this.store.problem.value = appText.handEnded(state.reason);
      }
    });
    if (state.kind !== 'holding') this.rumble.forget();
  }

  /** The session that was steered before the page was loaded anew. */
  rememberedId(): string | null {
    return this.window.remembered.getItem(rememberedKey);
  }

  /** There is nothing to go on steering. */
  forget(): void {
    this.window.remembered.removeItem(rememberedKey);
  }

  /** The level that a session has, or that another one like it should have. */
  levelOf(session: Session): LevelName {
    return levelOf(session, this.levels.of(session));
  }

  /**
   * Steers a session from here; another page that does so is sent away by the server. Without a `level` it is the one
   * that the session has.
   */
  steer(sessionId: string, level: LevelName = this.levelOfWatched(sessionId)): void {
    this.window.remembered.setItem(rememberedKey, sessionId);
    this.levels.keep(sessionId, level);
    const { ownPressure } = levels[level];
    this.practice.hand.reset({ pose: startPose(levels[level], randomOf(sessionId)), ownPressure });
    batch(() => {
      this.practice.sessionId.value = sessionId;
      this.practice.level.value = level;
      this.practice.lastSessionId.value = sessionId;
      this.practice.feedback.value = null;
    });
    this.link.connect(this.deviceUrl(sessionId));
    clearInterval(this.timer);
    this.steppedMs = this.window.nowMs();
    this.timer = setInterval(() => this.step(), stepMs);
  }

  private levelOfWatched(sessionId: string): LevelName {
    const session = this.store.watched.value;
    return session?.id === sessionId ? this.levelOf(session) : 'guided';
  }

  /** The session goes on without this hand. */
  leave(): void {
    clearInterval(this.timer);
    this.practice.hand.letGo();
    this.link.disconnect();
    this.rumble.forget();
    this.forget();
    batch(() => {
      this.practice.sessionId.value = null;
      this.practice.feedback.value = null;
    });
  }

  /** The page is left or covered: at once, since timers of a hidden page are slow. */
  letGo(): void {
    this.practice.hand.letGo();
    this.sendInput();
  }

  private step(): void {
    const now = this.window.nowMs();
    const seconds = Math.min((now - this.steppedMs) / 1000, longestStepS);
    this.steppedMs = now;
    const plan = this.practice.plan.value;
    if (plan === null) return;
    const { hand } = this.practice;
    const gamepad = this.window.gamepad();
    batch(() => {
      this.practice.gamepad.value = gamepad !== null;
      this.keys.step(seconds);
      if (this.pad.step(gamepad, seconds, this.view.screenAxes(plan))) {
        hand.takeHold();
        this.practice.input.take('gamepad');
      }
      if (!this.window.attended()) hand.letGo();
      hand.step(seconds);
    });
    this.rumble.play(gamepad?.vibrationActuator, now);
    this.sendInput();
  }

  private sendInput(): void {
    const plan = this.practice.plan.value;
    if (plan !== null) this.socket.steer(this.practice.hand.input(plan));
  }
}
