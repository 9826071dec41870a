import { computed, signal } from '@preact/signals';

import { slicePlanes } from '../../ct/orientation';
import type { VoxelBox } from '../../ct/slice_layout';
import { VolumeFrame } from '../../ct/volume_frame';
import { type WindowLevel, windowPresets } from '../../ct/window_level';
import type {
  PlanAssessment,
  PlanOutcome,
  Case,
  Job,
  Plan,
  Reamer,
  SeedName,
  FullSegmentationSettings,
  Triple,
} from '../../wire/rest_types';
import type { StepName } from './case_steps';
import type { LandmarkName } from './landmark_names';

/** What the next click places. */
export type Armed = { kind: 'landmark'; name: LandmarkName } | { kind: 'seed'; name: SeedName } | null;

/** A plan that is worked on. */
export interface PlanDraft {
  plan: Plan;
  assessment: PlanAssessment | null;
  /** Where it is carried out exactly. */
  outcome: PlanOutcome | null;
  /** Assessment and outcome are of this plan, not of one before it was changed by hand. */
  isAssessed: boolean;
  /** The server has it as the case's plan. */
  kept: boolean;
}

export interface Framed {
  box: VoxelBox | null;
}

export type SurfaceState =
  { kind: 'none' } | { kind: 'loading' } | { kind: 'shown' } | { kind: 'failed'; message: string };

/** What the Case page knows of its case. Written by the controller and by what the user's hand does to the views. */
export class CaseStore {
  readonly details = signal<Case | null>(null);
  /** Why the case cannot be shown. */
  readonly loadProblem = signal<string | null>(null);
  /** What last went wrong at the user's hand. */
  readonly problem = signal<string | null>(null);
  readonly busy = signal(false);

  readonly job = signal<Job | null>(null);
  /** The server does not answer; the job's progress is what was last heard. */
  readonly jobSilent = signal(false);

  readonly openStep = signal<StepName | null>('segment');
  readonly armed = signal<Armed>(null);

  /** In voxels, see VolumeFrame. */
  readonly crossHair = signal<Triple>([0, 0, 0]);
  /** HU at the cross-hair; null while its slice is on its way. */
  readonly crossHairHu = signal<number | null>(null);
  /** What the slices were last made to show whole; null: the whole CT. A new object shows it anew. */
  readonly framed = signal<Framed>({ box: null });
  readonly window = signal<WindowLevel>(windowPresets.bone);
  readonly labelsShown = signal(true);
  readonly previewShown = signal(true);

  /** As the sliders stand; null until the case is known. */
  readonly settings = signal<FullSegmentationSettings | null>(null);

  readonly reamers = signal<readonly Reamer[]>([]);
  readonly draft = signal<PlanDraft | null>(null);
  /** Why nobody knows what the draft would do. */
  readonly predictionProblem = signal<string | null>(null);
  /** Landmarks were changed after the plan was kept. */
  readonly planBeforeLandmarks = signal(false);
  /** The server asks for an override, with its reason. */
  readonly overrideRequired = signal<string | null>(null);

  readonly surface = signal<SurfaceState>({ kind: 'none' });

  private readonly ct = computed(() => this.details.value?.ct ?? null);
  readonly frame = computed(() => (this.ct.value === null ? null : new VolumeFrame(this.ct.value)));
  readonly planes = computed(() => (this.frame.value === null ? null : slicePlanes(this.frame.value)));
  readonly crossHairMm = computed(() => this.frame.value?.worldFromVoxel(this.crossHair.value) ?? null);
  /** HU from which pixels are tinted. */
  readonly previewFromHu = computed(() =>
    this.openStep.value === 'segment' && this.previewShown.value ? (this.settings.value?.threshold_hu ?? null) : null,
  );
}
