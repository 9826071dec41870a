import { computed, type ReadonlySignal } from '@preact/signals';

import { type Outline, reamerOutline } from '../../ct/reamer_shape';
import type { SeedName, Triple } from '../../wire/rest_types';
import type { CaseController } from './case_controller';
import { landmarkNames, type LandmarkName, pointOf } from './landmark_names';

/** A point that is drawn in slices and on the surface. World frame. */
export interface PointMark {
  of: { kind: 'landmark'; name: LandmarkName } | { kind: 'seed'; name: SeedName } | { kind: 'entry' };
  point: Triple;
  /** One or two signs. */
  text: string;
  active: boolean;
  /** Of a ball around the point, mm; 0: just the point. */
  ballRadiusMm: number;
}

export interface PlanMark {
  entry: Triple;
  /** Unit, into the bone. */
  direction: Triple;
  depthMm: number;
  outline: Outline;
  /** The server has this plan. */
  kept: boolean;
}

export const seedNames: readonly SeedName[] = ['scapula', 'humerus', 'clavicle'];

/** What is drawn over the CT and beside the surface, and what of it may be dragged now. */
export class ViewMarks {
  readonly points: ReadonlySignal<readonly PointMark[]>;
  readonly plan: ReadonlySignal<PlanMark | null>;

  constructor(private readonly controller: CaseController) {
    const { store } = controller;
    this.points = computed(() => {
      if (store.openStep.value === 'segment') return this.seeds();
      const entry = store.draft.value?.plan.entry_mm;
      const marks = this.landmarks();
      if (entry !== undefined && store.openStep.value === 'plan')
        marks.push({ of: { kind: 'entry' }, point: entry, text: '', active: true, ballRadiusMm: 0 });
      return marks;
    });
    this.plan = computed(() => {
      const draft = store.draft.value;
      const step = store.openStep.value;
      if (draft === null || step === 'segment' || step === 'landmarks') return null;
      const reamer = store.reamers.value.find((r) => r.words === draft.plan.reamer || r.name === draft.plan.reamer);
      return {
        entry: draft.plan.entry_mm,
        direction: draft.plan.axis_direction,
        depthMm: draft.plan.depth_mm,
        outline: reamerOutline(reamer),
        kept: draft.kept,
      };
    });
  }

  /** Whether a mark moves when it is dragged in the step that is open. */
  draggable({ of }: PointMark): boolean {
    const step = this.controller.store.openStep.value;
    return of.kind === 'entry' ? step === 'plan' : of.kind === 'seed' ? step === 'segment' : step === 'landmarks';
  }

  move({ of }: PointMark, point: Triple): void {
    const { store } = this.controller;
    if (of.kind === 'landmark') {
      this.controller.place(of.name, point);
    } else if (of.kind === 'seed') {
      const settings = store.settings.value;
      if (settings !== null) store.settings.value = { ...settings, seeds: { ...settings.seeds, [of.name]: point } };
    } else {
      const plan = store.draft.value?.plan;
      if (plan !== undefined) this.controller.draftPlan({ ...plan, entry_mm: point });
    }
  }

  private landmarks(): PointMark[] {
    const landmarks = this.controller.landmarks.landmarks.value;
    const armed = this.controller.store.armed.value;
    return landmarkNames.flatMap((name, i) => {
      const point = pointOf(landmarks, name);
      if (point === null) return [];
      const active = armed?.kind === 'landmark' && armed.name === name;
      const ballRadiusMm = name === 'humeral_head' ? (landmarks.humeral_head?.radius_mm ?? 0) : 0;
      return [{ of: { kind: 'landmark' as const, name }, point, text: String(i + 1), active, ballRadiusMm }];
    });
  }

  private seeds(): PointMark[] {
    const { settings, armed } = this.controller.store;
    const seeds = settings.value?.seeds ?? {};
    return seedNames.flatMap((name) => {
      const point = seeds[name];
      if (point === undefined) return [];
      const active = armed.value?.kind === 'seed' && armed.value.name === name;
      const text = name.charAt(0).toUpperCase();
      return [{ of: { kind: 'seed' as const, name }, point, text, active, ballRadiusMm: 0 }];
    });
  }
}
