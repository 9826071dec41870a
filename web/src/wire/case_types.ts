/** Cases, their CT and the work on it, as REST describes them. Points and lengths are mm in the CT's LPS. */

export type Triple = [number, number, number];
export type Side = 'left' | 'right';
export type Stage = 'ct' | 'segmented' | 'built';
/** A voxel axis of the CT, and the slices across it. */
export type VoxelAxis = 'u' | 'v' | 'w';

export interface CaseSummary {
  id: string;
  name: string;
  side: Side;
  stage: Stage;
  /** Of the built bone; null before. */
  dims: Triple | null;
  spacing_mm: Triple | null;
  planned: boolean;
}

export interface CtDescription {
  dims: Triple;
  spacing_mm: Triple;
  world_from_volume: { rotation: [Triple, Triple, Triple]; translation_mm: Triple };
  hu_min: number;
  hu_max: number;
  source: string;
  revision: number;
  suggested_threshold_hu: number;
}

export type SeedName = 'scapula' | 'humerus' | 'clavicle';
export type Seeds = Partial<Record<SeedName, Triple>>;

export interface SegmentationSettings {
  threshold_hu: number;
  sigma_mm: number;
  separate: boolean;
  seeds: Seeds;
  fill_holes: boolean;
}

/** As the server keeps them: what was left to it is absent. */
export type KeptSettings = Partial<SegmentationSettings>;

export interface Part {
  label: number;
  name: string;
  voxels: number;
  volume_mm3: number;
  centre_mm: Triple;
  low_mm: Triple;
  high_mm: Triple;
}

export interface Segmentation {
  revision: number;
  can_undo: boolean;
  settings: KeptSettings;
  /** That was used. */
  threshold_hu?: number;
  parts: Part[];
  warnings: string[];
}

export type PointName =
  | 'glenoid_centre_mm'
  | 'superior_rim_mm'
  | 'inferior_rim_mm'
  | 'anterior_rim_mm'
  | 'posterior_rim_mm'
  | 'trigonum_mm'
  | 'inferior_angle_mm';

export const walchClasses = ['A1', 'A2', 'B1', 'B2', 'B3', 'C1', 'C2', 'D'] as const;
export type WalchClass = (typeof walchClasses)[number];

export interface HumeralHead {
  centre_mm: Triple;
  radius_mm: number;
}

/** landmarks.json: what has been placed; absent is what has not. */
export type Landmarks = Partial<Record<PointName, Triple>> & {
  humeral_head?: HumeralHead;
  /** Anterior edge of the paleoglenoid, ridge, posterior edge of the neoglenoid; all three or none. */
  biconcavity_mm?: Triple[];
  walch?: WalchClass;
};

export interface NormalRange {
  mean: number;
  low?: number;
  high?: number;
  source: string;
}

export interface Measures {
  version_3d_deg: number | null;
  inclination_3d_deg: number | null;
  version_friedman_deg: number | null;
  inclination_friedman_deg: number | null;
  /** Of the head's diameter behind the scapular plane. */
  subluxation_percent: number | null;
  /** Behind the plane square to the glenoid's face. */
  subluxation_glenoid_percent?: number | null;
  /** Versions of a biconcave face and the angle between its hollows, degrees, by their keys. */
  biconcavity: Record<string, number> | null;
  normal: {
    version_deg?: NormalRange;
    inclination_deg?: NormalRange;
    subluxation_percent?: NormalRange;
  };
  missing: string[];
  words: { version?: string | null; inclination?: string | null };
}

export type Guide = 'none' | 'nipple' | 'pin';

/** plan.json; keys that this page does not know are kept as they are. */
export interface Plan {
  entry_mm: Triple;
  /** Unit, into the bone. */
  axis_direction: Triple;
  depth_mm: number;
  reamer: string;
  pilot_diameter_mm?: number | null;
  pilot_depth_mm?: number | null;
  guide?: Guide;
  implant_radius_mm?: number;
  [key: string]: unknown;
}

export interface Assessment {
  correction_deg: number | null;
  version_after_deg: number | null;
  inclination_after_deg: number | null;
  /** Bone along the axis, from the entry to the far cortex. */
  vault_depth_mm?: number | null;
  warnings: string[];
  needs_override: boolean;
}

export interface AssessedPlan {
  plan: Plan;
  assessment: Assessment;
}

/** What is wished of a plan; absent is left to the server. */
export interface PlanWishes {
  version_deg?: number;
  inclination_deg?: number;
  depth_mm?: number;
  implant_radius_mm?: number;
  reamer?: string;
  pilot_diameter_mm?: number;
  pilot_depth_mm?: number;
  guide?: Guide;
}

export interface Reamer {
  name: string;
  /** How a plan names it. */
  words: string;
  diameter_mm: number;
  radius_mm: number | null;
  nipple: { radius_mm: number; height_mm: number } | null;
  cannulated: boolean;
  description: string;
}

export interface BuiltBone {
  upsample: number;
  roi_mm: number[] | null;
  cartilage_mm: number;
  bone_voxels: number;
  density_range_g_cc: [number, number];
  segmentation_revision: number;
}

export interface BuildWishes {
  upsample: number;
  roi: 'glenoid' | 'whole';
  cartilage_mm: number;
}

export interface CaseDetails extends CaseSummary {
  warnings: string[];
  ct: CtDescription | null;
  segmentation: Segmentation | null;
  landmarks: Landmarks | null;
  plan: Plan | null;
  built: BuiltBone | null;
}

export interface Upload {
  id: string;
  name: string;
  bytes: number;
  received: number;
}

export type JobState = 'waiting' | 'running' | 'done' | 'failed' | 'cancelled';

export interface Job {
  id: string;
  kind: 'import' | 'segmentation' | 'build';
  case_id: string;
  state: JobState;
  /** 0 to 1. */
  share: number;
  step: string;
  problem: { status?: number; title?: string; detail?: string } | null;
}

export interface NewCase {
  upload_id: string;
  side: Side;
  id?: string;
  name?: string;
  series_uid?: string;
}
