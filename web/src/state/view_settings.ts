import { computed, effect, signal } from '@preact/signals';

export const sectionNames = ['axial', 'coronal', 'sagittal'] as const;
export type SectionName = (typeof sectionNames)[number];

/** A plane of the patient's that cuts the bone; the side towards above, front or outside goes, flipped the other. */
export interface Section {
  on: boolean;
  /** From the planned entry towards above, the front, or outside. */
  offsetMm: number;
  flipped: boolean;
}

export const sectionReachMm = 40;
export const opacityLeast = 0.1;

/**
 * From what costs least to draw: plain, the reamer is see-through; in full it is an instrument that turns, and the rest of
 * the scapula is there, and spongy bone that was cut has pores; fine has shadows and darker hollows, too.
 */
export const pictureLevels = ['plain', 'full', 'fine'] as const;
export type PictureLevel = (typeof pictureLevels)[number];
export const pictureChoices = ['automatic', 'fine', 'full', 'plain'] as const;
export type PictureChoice = (typeof pictureChoices)[number];

/** How somebody wants to see the bone. */
export interface ViewChoices {
  /** One's own view, or the surgeon's at the beach chair, which follows the reamer. */
  camera: 'own' | 'trainee';
  cutAway: boolean;
  /** Painted by cortical and cancellous bone and cartilage, and where the reamer touches. */
  boneKinds: boolean;
  seeThrough: boolean;
  /** Of a bone that is seen through, 0 to 1. */
  opacity: number;
  sections: Record<SectionName, Section>;
  toolDrawing: PictureChoice;
}

const section: Section = { on: false, offsetMm: 0, flipped: false };
export const plainView: ViewChoices = {
  camera: 'own',
  cutAway: false,
  boneKinds: false,
  seeThrough: false,
  opacity: 0.4,
  sections: { axial: section, coronal: section, sagittal: section },
  toolDrawing: 'automatic',
};
/** All that a surgeon sees in theatre. */
export const theatreView: ViewChoices = { ...plainView, camera: 'trainee' };

type Kept = Pick<Storage, 'getItem' | 'setItem'>;

/** What the picture shows, kept on this computer for each person that uses it. */
export class ViewSettings {
  readonly choices = signal<ViewChoices>(plainView);
  /** Nothing but the bone and an opaque reamer is seen, from where the surgeon stands. */
  readonly theatre = signal(false);
  /** For a while one's own camera, whatever is chosen and kept. */
  readonly ownForNow = signal(false);
  readonly camera = computed(() => (this.ownForNow.value ? 'own' : this.choices.value.camera));
  readonly shown = computed((): ViewChoices => {
    const { toolDrawing } = this.choices.value;
    if (this.theatre.value) return { ...theatreView, toolDrawing };
    return { ...this.choices.value, camera: this.camera.value };
  });

  change(part: Partial<ViewChoices>): void {
    if (part.camera !== undefined) this.ownForNow.value = false;
    this.choices.value = { ...this.choices.peek(), ...part };
  }

  changeSection(name: SectionName, part: Partial<Section>): void {
    const { sections } = this.choices.peek();
    const offsetMm = limited(part.offsetMm ?? sections[name].offsetMm, -sectionReachMm, sectionReachMm);
    this.change({ sections: { ...sections, [name]: { ...sections[name], ...part, offsetMm } } });
  }

  /** Takes up what this person chose last and keeps what is chosen from here on, until the result is called. */
  keepFor(person: string, storage: Kept): () => void {
    const key = `ream.view.${person}`;
    this.choices.value = viewFromText(storage.getItem(key));
    return effect(() => {
      try {
        storage.setItem(key, JSON.stringify(this.choices.value));
      } catch {
        // A browser that keeps nothing still shows what was chosen.
      }
    });
  }
}

/** What was kept; whatever is not as it should be is as at the first time. */
export function viewFromText(text: string | null): ViewChoices {
  const kept = parsed(text);
  const keptSections = asRecord(kept.sections);
  const sections = Object.fromEntries(sectionNames.map((name) => [name, keptSection(keptSections[name])]));
  return {
    camera: kept.camera === 'trainee' ? 'trainee' : 'own',
    cutAway: kept.cutAway === true,
    boneKinds: kept.boneKinds === true,
    seeThrough: kept.seeThrough === true,
    opacity: limited(numberOr(kept.opacity, plainView.opacity), opacityLeast, 1),
    sections: sections as Record<SectionName, Section>,
    toolDrawing: pictureChoices.find((one) => one === kept.toolDrawing) ?? plainView.toolDrawing,
  };
}

function keptSection(value: unknown): Section {
  const { on, offsetMm, flipped } = asRecord(value);
  const within = limited(numberOr(offsetMm, 0), -sectionReachMm, sectionReachMm);
  return { on: on === true, offsetMm: within, flipped: flipped === true };
}

function parsed(text: string | null): Record<string, unknown> {
  try {
    return asRecord(JSON.parse(text ?? '{}'));
  } catch {
    return {};
  }
}

const asRecord = (value: unknown): Record<string, unknown> =>
  typeof value === 'object' && value !== null ? (value as Record<string, unknown>) : {};
const numberOr = (value: unknown, otherwise: number): number =>
  typeof value === 'number' && Number.isFinite(value) ? value : otherwise;
const limited = (value: number, low: number, high: number): number => Math.min(Math.max(value, low), high);
