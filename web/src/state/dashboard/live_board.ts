import { batch, computed, signal } from '@preact/signals';

import type { Session, Metrics } from '../../wire/rest_types';
import { messageOf } from '../../wire/rest';

/** What the board asks for. */
export interface LiveSource {
  live(): Promise<Session[]>;
  soFar(id: string): Promise<Metrics>;
  picture(id: string): Promise<Blob>;
  plannedDepthMm(caseId: string): Promise<number | null>;
}

/** A session under way, as it was last heard of. */
export interface Tile {
  session: Session;
  soFar: Metrics | null;
  /** The reading before that. */
  before: Metrics | null;
  /** When `soFar` came, ms; null: never. */
  updatedMs: number | null;
  plannedDepthMm: number | null;
  /** Address of the newest picture, and when it came; null: none yet. */
  picture: string | null;
  pictureMs: number | null;
}

/** Sessions are read so often, and count as known for so long, ms. */
export const readEveryMs = 2000;
export const staleAfterMs = 5000;
/** Between two readings, however much changes, ms. */
const restMs = 300;
/** A picture takes the server some seconds, so they are asked for one after the other, and of one session so often. */
export const pictureEveryMs = 20_000;

/** The sessions that are under way, read again and again. */
export class LiveBoard {
  readonly tiles = signal<readonly Tile[]>([]);
  /** Words about what failed last; null: nothing since. */
  readonly problem = signal<string | null>(null);
  /** When the sessions were last heard of, ms; null: never. */
  readonly updatedMs = signal<number | null>(null);
  private readonly nowMs = signal(Date.now());
  private readonly lost = signal(false);
  /** Nothing of what is shown is known to be so now. */
  readonly stale = computed(
    () => this.updatedMs.value !== null && (this.lost.value || this.nowMs.value - this.updatedMs.value > staleAfterMs),
  );

  private timers: ReturnType<typeof setInterval>[] = [];
  private reading = false;
  private readAgain = false;
  private drawing = false;
  /** Grows when the board is left: answers that come then are of before. */
  private turn = 0;
  private readonly plans = new Map<string, number | null>();
  /** When a picture of a session was last asked for, ms. */
  private readonly pictureRequestMs = new Map<string, number>();

  constructor(
    private readonly source: LiveSource,
    private readonly addressOf: (picture: Blob) => string = (picture) => URL.createObjectURL(picture),
    private readonly forget: (address: string) => void = (address) => URL.revokeObjectURL(address),
  ) {}

  start(): void {
    if (this.timers.length > 0) return;
    this.timers = [
      setInterval(() => void this.read(), readEveryMs),
      setInterval(() => (this.nowMs.value = Date.now()), 500),
    ];
    void this.read();
  }

  /** What was read is of no more use from here on. */
  stop(): void {
    this.timers.forEach(clearInterval);
    this.timers = [];
    ++this.turn;
    this.reading = this.readAgain = this.drawing = false;
    this.forgetPicturesBut([]);
    batch(() => {
      this.tiles.value = [];
      this.updatedMs.value = null;
      this.problem.value = null;
      this.lost.value = false;
    });
  }

  /** News stopped: until a reading succeeds nothing counts as known. */
  loseTouch(): void {
    this.lost.value = true;
    void this.read();
  }

  /** Reads now; once more when something changed meanwhile. */
  async read(): Promise<void> {
    if (this.reading) {
      this.readAgain = true;
      return;
    }
    this.reading = true;
    const { turn } = this;
    try {
      const sessions = await this.source.live();
      if (turn !== this.turn) return;
      batch(() => {
        this.forgetPicturesBut(sessions);
        this.tiles.value = sessions.map((session) => this.tileOf(session));
        this.updatedMs.value = this.nowMs.value = Date.now();
        this.lost.value = false;
        this.problem.value = null;
      });
      await Promise.all(sessions.map((session) => this.readFigures(session)));
      if (turn === this.turn) void this.drawNext();
    } catch (error) {
      if (turn !== this.turn) return;
      batch(() => {
        this.problem.value = messageOf(error);
        this.lost.value = true;
      });
    } finally {
      if (turn === this.turn) this.endReading(turn);
    }
  }

  private endReading(turn: number): void {
    this.reading = false;
    if (!this.readAgain) return;
    this.readAgain = false;
    setTimeout(() => {
      if (turn === this.turn) void this.read();
    }, restMs);
  }

  /** Whether the figures of one tile are older than what counts as known. */
  isOld(tile: Tile): boolean {
    return this.stale.value || (tile.updatedMs !== null && this.nowMs.value - tile.updatedMs > staleAfterMs);
  }

  private forgetPicturesBut(sessions: readonly Session[]): void {
    for (const { session, picture } of this.tiles.value) {
      if (sessions.some((one) => one.id === session.id)) continue;
      if (picture !== null) this.forget(picture);
      this.pictureRequestMs.delete(session.id);
    }
  }

  private tileOf(session: Session): Tile {
    const known = this.tiles.value.find((tile) => tile.session.id === session.id);
    const plannedDepthMm = this.plans.get(session.case) ?? null;
    if (known !== undefined) return { ...known, session, plannedDepthMm };
    return { session, soFar: null, before: null, updatedMs: null, plannedDepthMm, picture: null, pictureMs: null };
  }

  /** Figures are a supplement: without them the tile says what it knows. */
  private async readFigures(session: Session): Promise<void> {
    const { turn } = this;
    const [soFar] = await Promise.all([
      this.source.soFar(session.id).catch(() => null),
      this.plans.has(session.case) ? undefined : this.readPlan(session.case),
    ]);
    if (turn !== this.turn) return;
    const plannedDepthMm = this.plans.get(session.case) ?? null;
    this.change(session.id, (tile) =>
      soFar === null
        ? { ...tile, plannedDepthMm }
        : { ...tile, plannedDepthMm, before: tile.soFar, soFar, updatedMs: Date.now() },
    );
  }

  private async readPlan(caseId: string): Promise<void> {
    const depthMm = await this.source.plannedDepthMm(caseId).catch(() => undefined);
    if (depthMm !== undefined) this.plans.set(caseId, depthMm);
  }

  /** The picture that is most due, if any is. */
  private async drawNext(): Promise<void> {
    const now = Date.now();
    const requestedMs = (tile: Tile) => this.pictureRequestMs.get(tile.session.id) ?? -Infinity;
    const [due] = [...this.tiles.value].sort((a, b) => requestedMs(a) - requestedMs(b));
    if (this.drawing || due === undefined || now - requestedMs(due) < pictureEveryMs) return;
    this.drawing = true;
    const { turn } = this;
    const { id } = due.session;
    this.pictureRequestMs.set(id, now);
    const blob = await this.source.picture(id).catch(() => null);
    if (turn !== this.turn) return;
    this.drawing = false;
    if (blob === null) return;
    this.change(id, (tile) => {
      if (tile.picture !== null) this.forget(tile.picture);
      return { ...tile, picture: this.addressOf(blob), pictureMs: Date.now() };
    });
  }

  private change(id: string, to: (tile: Tile) => Tile): void {
    this.tiles.value = this.tiles.value.map((tile) => (tile.session.id === id ? to(tile) : tile));
  }
}
