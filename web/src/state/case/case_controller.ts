import { batch } from '@preact/signals';

import { SliceCache } from '../../ct/slice_cache';
import type { CaseApi } from '../../wire/case_api';
import type {
  BuildSettings,
  Case,
  CaseCt,
  Job,
  BonePart,
  Plan,
  PlanTargets,
  CaseSegmentation,
  FullSegmentationSettings,
  Triple,
} from '../../wire/rest_types';
import { ApiError, messageOf } from '../../wire/rest';
import { type Armed, CaseStore, type PlanDraft } from './case_store';
import { nextStep, stepStates } from './case_steps';
import { followJob, isUnderWay, pause } from './job_watch';
import { LandmarkEditor } from './landmark_editor';
import { newPlanOf, PlanPrediction } from './plan_prediction';
import { landmarkNames, type LandmarkName, nextMissing, placedFrom, pointOf, withPoint } from './landmark_names';

/** Around a part that the slices show whole. */
const partMarginMm = 12;

/** What a plan's result depends on beside the plan. */
const plannedOn = ({ landmarks, segmentation, built }: Case): string =>
  JSON.stringify([landmarks, segmentation?.revision, built]);

/** Opens one case and carries out what the user asks for on its page. */
export class CaseController {
  readonly store = new CaseStore();
  readonly landmarks: LandmarkEditor;
  readonly slices: SliceCache;
  private readonly prediction: PlanPrediction;
  private readonly ended = new AbortController();

  constructor(
    private readonly api: CaseApi,
    readonly caseId: string,
    /** Else the case is only looked at, and reamed. */
    readonly mayEdit = true,
  ) {
    this.landmarks = new LandmarkEditor(api, caseId, (saved) => this.take(saved));
    this.prediction = new PlanPrediction(api, caseId, this.store.draft, this.store.predictionProblem);
    this.slices = new SliceCache(({ of, revision, axis, index }, signal) =>
      api.slice(caseId, of, revision, axis, index, signal),
    );
  }

  async open(): Promise<void> {
    const { store } = this;
    store.loadProblem.value = null;
    try {
      const details = await this.api.case(this.caseId);
      if (this.ended.signal.aborted) return;
      batch(() => {
        this.take(details);
        store.draft.value = null;
        store.openStep.value = this.mayEdit
          ? nextStep(stepStates({ details, landmarks: placedFrom(details.landmarks), planBeforeLandmarks: false }))
          : 'ream';
      });
      this.landmarks.take(details.landmarks);
      this.armFirstMissing();
      this.frameScapula();
      if (details.plan !== null) {
        this.takeDraft({ plan: details.plan, assessment: null, outcome: null, isAssessed: false, kept: true });
        this.lookAt(details.plan.entry_mm);
      }
      const [reamers, jobs] = await Promise.all([
        this.api.reamers().catch(() => []),
        this.mayEdit ? this.api.jobs(this.caseId).catch(() => []) : [],
      ]);
      store.reamers.value = reamers;
      const underWay = jobs.find(isUnderWay);
      if (underWay !== undefined) void this.follow(underWay);
    } catch (error) {
      store.loadProblem.value = messageOf(error);
    }
  }

  /** Gives up everything under way on this page; jobs go on on the server. */
  leave(): void {
    this.landmarks.leave();
    this.ended.abort();
    this.slices.clear();
  }

  meshUrl(): string {
    return this.api.meshUrl(this.caseId);
  }

  segment(settings: FullSegmentationSettings): Promise<void> {
    return this.run(async () => void (await this.follow(await this.api.segment(this.caseId, settings))));
  }
  undoSegmentation(): Promise<void> {
    return this.run(async () => {
      const details = await this.api.undoSegmentation(this.caseId);
      this.take(details);
      if (details.ct !== null) this.store.settings.value = settingsOf(details.ct, details.segmentation);
    });
  }
  build(settings: BuildSettings): Promise<void> {
    return this.run(async () => void (await this.follow(await this.api.build(this.caseId, settings))));
  }
  cancelJob(): Promise<void> {
    return this.run(async () => {
      const job = this.store.job.value;
      if (job !== null) this.store.job.value = await this.api.cancel(job.id);
    });
  }

  proposePlan(targets: PlanTargets): Promise<void> {
    return this.run(async () => {
      await this.landmarks.saveNow();
      const { plan, assessment } = await this.api.proposePlan(this.caseId, targets);
      this.takeDraft({ plan, assessment, outcome: null, isAssessed: true, kept: false });
      this.lookAt(plan.entry_mm);
    });
  }

  /** The plan as it is changed by hand; nothing is saved, and an override was of the plan before. */
  draftPlan(changed: Plan): void {
    const draft = this.store.draft.value;
    const plan = { ...changed };
    delete plan.override;
    delete plan.override_reason;
    const { assessment, outcome } = draft ?? { assessment: null, outcome: null };
    this.takeDraft({ plan, assessment, outcome, isAssessed: false, kept: false });
  }

  private takeDraft(draft: PlanDraft): void {
    batch(() => {
      this.store.draft.value = draft;
      this.store.overrideRequired.value = null;
    });
    if (this.mayEdit) void this.prediction.update(this.ended.signal);
  }

  /** Makes the draft the case's plan; `override` is the reason for a correction that is refused without one. */
  keepPlan(override: string | null): Promise<void> {
    return this.run(async () => {
      const draft = this.store.draft.value;
      if (draft === null) return;
      const overriding = override === null ? {} : { override: true, override_reason: override };
      try {
        const { plan, assessment } = await this.api.putPlan(this.caseId, { ...newPlanOf(draft.plan), ...overriding });
        const now = this.store.draft.value;
        batch(() => {
          // What was changed meanwhile is not saved.
          if (now !== null && now.plan === draft.plan) this.takeDraft({ ...now, plan, assessment, kept: true });
          this.store.planBeforeLandmarks.value = false;
        });
        this.take(await this.api.case(this.caseId));
      } catch (error) {
        if (!(error instanceof ApiError) || error.status !== 409) throw error;
        this.store.overrideRequired.value = error.message;
      }
    });
  }

  /** Places what the next click places, and arms what comes after it. */
  placeArmed(point: Triple): void {
    const armed = this.store.armed.value;
    if (armed === null) return;
    if (armed.kind === 'seed') {
      const settings = this.store.settings.value;
      if (settings !== null)
        this.store.settings.value = { ...settings, seeds: { ...settings.seeds, [armed.name]: point } };
      this.store.armed.value = null;
      return;
    }
    this.place(armed.name, point);
    this.armNext(armed.name);
  }

  /** Whether the next click places something that is not placed yet. */
  placesNew(): boolean {
    const armed = this.store.armed.value;
    if (armed === null) return false;
    if (armed.kind === 'seed') return this.store.settings.value?.seeds[armed.name] === undefined;
    return pointOf(this.landmarks.landmarks.value, armed.name) === null;
  }

  /** A mark was taken into the hand: it is what the next click would place. */
  chooseMark(of: NonNullable<Armed> | { kind: 'entry' }): void {
    if (!this.mayEdit) return;
    const armed = this.store.armed.value;
    if (of.kind === 'entry' || (armed?.kind === of.kind && armed.name === of.name)) return;
    this.store.armed.value = of;
  }

  place(name: LandmarkName, point: Triple | null): void {
    this.landmarks.change(withPoint(this.landmarks.landmarks.value, name, point));
    if (this.store.details.value?.plan !== null) this.store.planBeforeLandmarks.value = true;
  }

  /** Chooses a landmark; the views go to it where it is placed, else the next click places it. */
  choose(name: LandmarkName): void {
    if (this.mayEdit) {
      this.store.openStep.value = 'landmarks';
      this.store.armed.value = { kind: 'landmark', name };
    }
    const point = pointOf(this.landmarks.landmarks.value, name);
    if (point !== null) this.lookAt(point);
  }

  chooseByNumber(number: number): void {
    const name = landmarkNames[number - 1];
    if (name !== undefined) this.choose(name);
  }

  /** What is missing first is what the next click in the landmarks' step places. */
  armFirstMissing(): void {
    if (this.store.openStep.value === 'landmarks') this.armNext(null);
  }

  lookAt(point: Triple): void {
    const frame = this.store.frame.value;
    if (frame !== null) this.store.crossHair.value = frame.clampVoxel(frame.voxelFromWorld(point));
  }

  /** The slices show a part of the bones, or (null) the whole CT. */
  framePart(part: BonePart | null): void {
    const frame = this.store.frame.value;
    if (frame === null) return;
    const box = part === null ? null : frame.voxelBox(part.low_mm, part.high_mm, partMarginMm);
    this.store.framed.value = { box };
  }

  /** A case of the same CT for the other shoulder; its id once it is there. */
  async copyForOtherSide(): Promise<string | null> {
    let made: string | null = null;
    await this.run(async () => {
      const side = this.store.details.value?.side === 'left' ? 'right' : 'left';
      const job = await this.follow(await this.api.copyCase(this.caseId, side));
      if (job?.state === 'done') made = job.case_id;
    });
    return made;
  }

  private frameScapula(): void {
    const scapula = this.store.details.value?.segmentation?.parts.find(({ label }) => label === 1);
    if (scapula === undefined) return;
    this.framePart(scapula);
    this.lookAt(scapula.centre_mm);
  }

  private armNext(after: LandmarkName | null): void {
    const name = nextMissing(this.landmarks.landmarks.value, after);
    this.store.armed.value = name === null ? null : { kind: 'landmark', name };
  }

  private async follow(first: Job): Promise<Job | null> {
    const { store } = this;
    const ended = await followJob(
      first,
      {
        api: this.api,
        onJob: (job) => (store.job.value = job),
        onSilence: (silent) => (store.jobSilent.value = silent),
        pause,
      },
      this.ended.signal,
    );
    if (ended?.state === 'done') {
      const isFirst = store.details.value?.segmentation === null;
      this.take(await this.api.case(this.caseId));
      store.job.value = null;
      if (isFirst && ended.kind === 'segmentation') this.frameScapula();
    }
    return ended;
  }

  private take(details: Case): void {
    const { store } = this;
    const before = store.details.value;
    batch(() => {
      store.details.value = details;
      if (details.ct === null) return;
      if (before?.ct?.revision !== details.ct.revision) {
        this.slices.clear();
        const frame = store.frame.value;
        if (frame !== null) store.crossHair.value = frame.middle();
      }
      store.settings.value ??= settingsOf(details.ct, details.segmentation);
    });
    const draft = store.draft.value;
    if (before !== null && draft !== null && plannedOn(before) !== plannedOn(details))
      this.takeDraft({ ...draft, isAssessed: false });
  }

  private async run(action: () => Promise<void>): Promise<void> {
    const { store } = this;
    store.busy.value = true;
    store.problem.value = null;
    try {
      await action();
    } catch (error) {
      store.problem.value = messageOf(error);
    } finally {
      store.busy.value = false;
    }
  }
}

/** With which the bones were found, or what is suggested before. */
export function settingsOf(ct: CaseCt, found: CaseSegmentation | null): FullSegmentationSettings {
  const { settings = {} } = found ?? {};
  const threshold_hu = settings.threshold_hu ?? found?.threshold_hu ?? Math.round(ct.suggested_threshold_hu);
  return { sigma_mm: 0, separate: true, seeds: {}, fill_holes: true, ...settings, threshold_hu };
}
