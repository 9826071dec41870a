import { computed, signal } from '@preact/signals';

import type { Mark, Metrics, Session } from '../wire/rest_types';
import type { LinkState } from '../wire/link';
import type { Hello, Playback, SessionState, Telemetry } from '../wire/messages';
import { LiveTrace } from './live_trace';
import { throttled } from './throttled';

/** Length of the force plot, seconds of session time. */
export const plotSeconds = 20;

/** News that is older than this is not shown as live. */
export const behindAtMostMs = 1500;

/** Numbers that change more often are not read, and cost a slow computer its pictures. */
const readEveryMs = 100;

/** What the page knows. Written by the watcher, read by panels and scene. */
export class Store {
  readonly link = signal<LinkState>({ kind: 'connecting' });
  readonly hello = signal<Hello | null>(null);
  readonly telemetry = signal<Telemetry | null>(null);
  /** State of the watched session, from whichever spoke last, telemetry or REST. */
  readonly sessionState = signal<SessionState | null>(null);
  readonly sessionId = signal<string | null>(null);
  /** The session that the user chose to watch; null: whichever is under way. */
  readonly chosenId = signal<string | null>(null);
  /** False from the loss of a stream until the next one has sent the whole picture. */
  readonly pictureComplete = signal(false);
  /** Whether a stream was lost since the page was opened. */
  readonly metWithLoss = signal(false);
  /** Whether any bone has ever come. */
  readonly hasPicture = signal(false);
  /** Wall-clock time of the last message, ms. */
  readonly lastMessageMs = signal<number | null>(null);
  /** Final figures of a session that has ended. */
  readonly metrics = signal<Metrics | null>(null);
  /** Words of the last thing that went wrong at the user's hand. */
  readonly problem = signal<string | null>(null);
  /** A request of the user's is under way. */
  readonly busy = signal(false);

  readonly reamerShown = signal(true);

  /** The watched session as REST last described it: health of its loop and its device. */
  readonly details = signal<Session | null>(null);

  /** The watched session as far as it is known. */
  readonly watched = computed(() => {
    const id = this.sessionId.value;
    const described = this.details.value;
    return described?.id === id ? described : (this.sessions.value.find((session) => session.id === id) ?? null);
  });

  /** All sessions that the server knows, newest first. */
  readonly sessions = signal<readonly Session[]>([]);
  /** The server has said which there are. */
  readonly sessionsKnown = signal(false);
  /** The replay that is to be watched; null: what is live. */
  readonly replayId = signal<string | null>(null);
  /** Where the watched replay stands; null while none is watched. */
  readonly playback = signal<Playback | null>(null);
  readonly marks = signal<readonly Mark[]>([]);
  /** What of the watched recording is damaged, in the server's words; null: nothing, as far as is known. */
  readonly recordingWarning = signal<string | null>(null);

  readonly trace = new LiveTrace(plotSeconds * 1000 + 1000);
  /** Grows when the trace changes. */
  readonly traceRevision = signal(0);

  /** Whether what is shown is a recording, or will be. */
  readonly replaying = computed(() => this.replayId.value !== null || (this.hello.value?.replayOf ?? '') !== '');
  /** How long what came last was on its way, beyond what it always takes; ms. Grows where the link is too slow. */
  readonly behindMs = signal(0);
  /** What is read as numbers: the newest telemetry, and how late; nothing of a session that is left. */
  readonly reading = throttled(
    computed(() => ({
      telemetry: this.telemetry.value,
      behindMs: this.behindMs.value,
      traceRevision: this.traceRevision.value,
    })),
    readEveryMs,
    ({ telemetry }) => telemetry === null,
  );
  /** In the server's words, why the session rests; empty: it does not. */
  readonly fault = computed(() => this.telemetry.value?.fault ?? '');
  readonly farBehind = computed(() => this.behindMs.value > behindAtMostMs);
  /** Whether what is shown is all that the stream has sent, of the present or of a recording. */
  readonly upToDate = computed(
    () => this.link.value.kind === 'live' && this.pictureComplete.value && !this.farBehind.value,
  );
  /** Whether the reamer is seen on bone; of a session that has ended the bone is seen as it was left. */
  readonly touching = computed(() => {
    const telemetry = this.telemetry.value;
    const ended = telemetry?.state === 'finished' || telemetry?.state === 'stopped' || telemetry?.state === 'fault';
    return this.upToDate.value && !ended && (telemetry?.densityGCc ?? 0) > 0;
  });
  /** Whether what is shown is the present state of the simulator. */
  readonly live = computed(() => this.upToDate.value && !this.replaying.value);
  readonly active = computed(() => this.sessionState.value === 'running' || this.sessionState.value === 'paused');
  /** Whether values of the moment can change: what was measured last says nothing of a reamer that nobody holds. */
  readonly moving = computed(() => this.active.value || this.replaying.value);
  /** What is read of the reamer at this moment; nothing once nobody holds it. What it did to the bone stays in `reading`. */
  readonly atReamer = computed(() => (this.moving.value ? this.reading.value.telemetry : null));
}
