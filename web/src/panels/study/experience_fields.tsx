import type { Signal } from '@preact/signals';

import { studyText } from '../../text/study_text';
import { type Experience, experiences } from '../../wire/rest_types';

export interface Background {
  experience: Experience | null;
  proceduresDone: number;
}

/** How much somebody has done of the real thing. */
export function ExperienceFields({ background }: { background: Signal<Background> }) {
  const set = (change: Partial<Background>) => (background.value = { ...background.value, ...change });
  return (
    <>
      <label>
        {studyText.experience}
        <select
          required
          data-testid="experience"
          value={background.value.experience ?? ''}
          onChange={(event) =>
            set({ experience: experiences.find((one) => one === event.currentTarget.value) ?? null })
          }
        >
          <option value="" />
          {experiences.map((level) => (
            <option key={level} value={level}>
              {studyText.experienceNames[level]}
            </option>
          ))}
        </select>
      </label>
      <label>
        {studyText.procedures}
        <input
          type="number"
          min={0}
          max={100000}
          step={1}
          required
          data-testid="procedures"
          value={background.value.proceduresDone}
          onChange={(event) => set({ proceduresDone: event.currentTarget.valueAsNumber })}
        />
      </label>
    </>
  );
}
