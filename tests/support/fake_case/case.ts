import { dims, FakeCt, headTruth, originMm, partsOf, spacingMm, surfacePly, truth } from './ct';

let ct: FakeCt | null = null;

interface Found {
  revision: number;
  settings: { threshold_hu: number };
  labels: Uint8Array;
}

/** One case of the fake server: its CT is always the same. */
export class FakeCase {
  readonly ct = (ct ??= new FakeCt());
  landmarks: Record<string, unknown> | null = null;
  plan: Record<string, unknown> | null = null;
  built: object | null = null;
  private readonly found: Found[] = [];
  private lastRevision = 0;

  constructor(
    readonly id: string,
    readonly name: string,
    readonly side: string,
  ) {}

  get labels(): Uint8Array | null {
    return this.found.at(-1)?.labels ?? null;
  }

  segment(settings: { threshold_hu?: number }): void {
    const threshold_hu = settings.threshold_hu ?? 226;
    const labels = this.ct.labels(threshold_hu);
    this.found.push({ revision: ++this.lastRevision, settings: { ...settings, threshold_hu }, labels });
  }
  undo(): void {
    if (this.found.length > 1) this.found.pop();
  }
  build(settings: { upsample: number; roi: string; cartilage_mm: number }): void {
    this.built = {
      ...settings,
      roi_mm: [-110, -20, -25, -70, 20, 25],
      bone_voxels: 1_234_567,
      density_range_g_cc: [0, 2.55],
      segmentation_revision: this.found.at(-1)?.revision ?? 0,
    };
  }

  summary(): object {
    const stage = this.built !== null ? 'built' : this.found.length > 0 ? 'segmented' : 'ct';
    const made =
      this.built === null
        ? { dims: null, spacing_mm: null }
        : { dims: [160, 160, 133], spacing_mm: [0.25, 0.25, 0.375] };
    return { id: this.id, name: this.name, side: this.side, stage, ...made, planned: this.plan !== null };
  }

  describe(): object {
    const found = this.found.at(-1);
    return {
      ...this.summary(),
      warnings: ['2 slices that belong to no series were left out'],
      ct: {
        ...{ dims, spacing_mm: spacingMm, hu_min: -1020, hu_max: 820, source: 'made up', revision: 1 },
        world_from_volume: {
          rotation: [
            [1, 0, 0],
            [0, 1, 0],
            [0, 0, 1],
          ],
          translation_mm: originMm,
        },
        suggested_threshold_hu: 226,
      },
      segmentation: found
        ? {
            ...{ revision: found.revision, can_undo: this.found.length > 1, settings: found.settings, warnings: [] },
            parts: partsOf(found.labels),
          }
        : null,
      landmarks: this.landmarks,
      plan: this.plan,
      built: this.built,
    };
  }

  mesh(): Buffer | null {
    return this.labels === null ? null : surfacePly(this.labels);
  }

  /** Figures that move when a landmark does; no anatomy. */
  measures(): object {
    const placed = this.landmarks ?? {};
    const missing = Object.keys(truth).filter((key) => !(key in placed));
    const centre = (placed.glenoid_centre_mm as number[] | undefined) ?? [0, 0, 0];
    const version = missing.length > 0 ? null : -8.1 + ((centre[1] ?? 0) - 0) * 0.5;
    const normal = (mean: number, low: number, high: number) => ({ mean, low, high, source: 'Churchill 2001' });
    return {
      version_3d_deg: version,
      inclination_3d_deg: missing.length > 0 ? null : 4.2,
      version_friedman_deg: version,
      inclination_trigonum_deg: missing.length > 0 ? null : 5.1,
      inclination_friedman_deg: missing.length > 0 ? null : 5.1,
      subluxation_percent: 'humeral_head' in placed && version !== null ? 52 : null,
      biconcavity: null,
      normal: {
        version_deg: normal(-1.23, -10.5, 9.5),
        inclination_deg: normal(4.2, -7, 15.8),
        subluxation_percent: normal(50, 45, 55),
      },
      missing: 'humeral_head' in placed ? missing : [...missing, 'humeral_head'],
      words: { version: null, inclination: null },
    };
  }

  propose(targets: { version_deg?: number; depth_mm?: number; reamer?: string }): object {
    const plan = {
      entry_mm: (this.landmarks ?? truth).glenoid_centre_mm,
      axis_direction: [1, 0, 0],
      depth_mm: targets.depth_mm ?? 2,
      reamer: targets.reamer ?? 'ellipse 18.25,9',
      pilot_diameter_mm: 6.2,
      pilot_depth_mm: 12,
      guide: 'nipple',
      ...(targets.version_deg === undefined ? {} : { version_deg: targets.version_deg }),
    };
    return { plan, assessment: this.assess(plan) };
  }

  /** The correction is what separates the wanted version from 8.1 degrees of retroversion. */
  assess(plan: Record<string, unknown>): { needs_override: boolean; correction_deg: number } {
    const after = (plan.version_deg as number | undefined) ?? 0;
    const correction_deg = Math.abs(after + 8.1);
    const assessment = {
      correction_deg,
      version_after_deg: after,
      inclination_after_deg: 4.2,
      warnings: correction_deg > 10 ? ['More than 10° of correction by reaming alone.'] : [],
      needs_override: correction_deg >= 15 && plan.override !== true,
    };
    return assessment;
  }

  /** The deeper, the more is gone, and the better the implant sits. */
  outcome(plan: Record<string, unknown>): object {
    const depth = plan.depth_mm as number;
    return {
      footprint_area_mm2: 500,
      depth_mean_mm: depth,
      medialization_mm: depth,
      seating_percent: Math.min(100, 40 * depth),
      plate_preserved_percent: Math.max(0, 100 - 30 * depth),
      joint_line_mm: 4 - depth,
      vault_distance_component_mm: 3 - depth,
      parts_through_vault: depth > 3 ? 1 : 0,
    };
  }
}

export { headTruth, truth };
