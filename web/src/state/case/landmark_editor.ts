import { batch, computed, signal } from '@preact/signals';

import type { CaseApi } from '../../wire/case_api';
import { messageOf } from '../../wire/rest';
import type { Case, Landmarks, Measures } from '../../wire/rest_types';
import { landmarksOf, placedFrom, type PlacedLandmarks, sameLandmarks } from './landmark_names';

const saveAfterMs = 350;

/**
 * - saved: the server has what is shown
 * - unsaved: a change waits for its moment; saving: it is on its way
 * - failed: the server did not take it; words say why
 * - conflict: somebody else changed the landmarks on the server meanwhile
 */
export type SaveState =
  | { kind: 'saved' }
  | { kind: 'unsaved' }
  | { kind: 'saving' }
  | { kind: 'failed'; message: string }
  | { kind: 'conflict'; theirs: Landmarks };

export type LandmarkApi = Pick<CaseApi, 'case' | 'putLandmarks' | 'measures' | 'putLandmarksOnLeaving'>;

/** The landmarks of one case: changed here at once, saved shortly after, and measured by the server once saved. */
export class LandmarkEditor {
  readonly landmarks = signal<PlacedLandmarks>({});
  readonly save = signal<SaveState>({ kind: 'saved' });
  /** Something was saved since the landmarks were read. */
  readonly hasSaved = signal(false);
  readonly measures = signal<Measures | null>(null);
  /** Why there are no measures, where the server refused. */
  readonly measuresProblem = signal<string | null>(null);
  /** Whether the measures are of the landmarks as they are shown. */
  readonly measured = computed(
    () => this.save.value.kind === 'saved' && this.measuredOf.value === this.landmarks.value,
  );
  private readonly measuredOf = signal<PlacedLandmarks | null>(null);

  /** As the server last sent them to this page. */
  private known: Landmarks = {};
  /** As they were sent when the page was about to go away, although it has stayed. */
  private sentAhead: Landmarks | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private saving = false;
  private ended = false;

  constructor(
    private readonly api: LandmarkApi,
    private readonly caseId: string,
    /** The server's case after a save. */
    private readonly onSaved: (saved: Case) => void,
  ) {}

  /** The server's landmarks, at the beginning or because they are to be taken. */
  take(landmarks: Landmarks | null): void {
    clearTimeout(this.timer);
    this.known = landmarks ?? {};
    this.sentAhead = null;
    batch(() => {
      this.landmarks.value = placedFrom(this.known);
      this.save.value = { kind: 'saved' };
    });
    void this.measure();
  }

  change(landmarks: PlacedLandmarks): void {
    this.landmarks.value = landmarks;
    if (this.save.value.kind === 'conflict') return;
    this.save.value = { kind: 'unsaved' };
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.saveNow(), saveAfterMs);
  }

  /** In a conflict: what is shown here replaces what somebody else saved. */
  async keepMine(): Promise<void> {
    if (this.save.value.kind === 'conflict') this.known = this.save.value.theirs;
    this.save.value = { kind: 'unsaved' };
    await this.saveNow();
  }

  takeTheirs(): void {
    if (this.save.value.kind === 'conflict') this.take(this.save.value.theirs);
  }

  /** Saves what waits to be saved. */
  async saveNow(): Promise<void> {
    clearTimeout(this.timer);
    if (this.saving || this.save.value.kind === 'saved' || this.save.value.kind === 'conflict') return;
    this.saving = true;
    const sent = this.landmarks.value;
    this.save.value = { kind: 'saving' };
    try {
      const now = await this.api.case(this.caseId);
      const isOurs = this.sentAhead !== null && sameLandmarks(now.landmarks, this.sentAhead);
      if (!isOurs && !sameLandmarks(now.landmarks, this.known)) {
        this.save.value = { kind: 'conflict', theirs: now.landmarks ?? {} };
        return;
      }
      const saved = await this.api.putLandmarks(this.caseId, landmarksOf(sent));
      this.known = saved.landmarks ?? {};
      this.sentAhead = null;
      this.hasSaved.value = true;
      this.onSaved(saved);
      this.save.value = this.landmarks.value === sent ? { kind: 'saved' } : { kind: 'unsaved' };
      if (this.save.value.kind === 'saved') await this.measure();
    } catch (error) {
      this.save.value = { kind: 'failed', message: messageOf(error) };
    } finally {
      this.saving = false;
      if (this.save.value.kind === 'unsaved' && !this.ended) this.change(this.landmarks.value);
    }
  }

  async measure(): Promise<void> {
    const of = this.landmarks.value;
    try {
      const measures = await this.api.measures(this.caseId);
      if (of !== this.landmarks.value) return;
      batch(() => {
        this.measures.value = measures;
        this.measuresProblem.value = null;
        this.measuredOf.value = of;
      });
    } catch (error) {
      if (of !== this.landmarks.value) return;
      batch(() => {
        this.measures.value = null;
        this.measuresProblem.value = messageOf(error);
      });
    }
  }

  /**
   * The page may go away: what waits is sent at once, without waiting for an answer. A browser gives a page that it has
   * left half a second, which a busy machine may not have. Where the page stays, it is saved as ever.
   */
  sendAhead(): void {
    const { kind } = this.save.value;
    if (kind === 'saved' || kind === 'conflict') return;
    this.sentAhead = landmarksOf(this.landmarks.value);
    this.api.putLandmarksOnLeaving(this.caseId, this.sentAhead);
  }

  /** The page goes away. */
  leave(): void {
    this.ended = true;
    clearTimeout(this.timer);
    this.sendAhead();
  }
}
