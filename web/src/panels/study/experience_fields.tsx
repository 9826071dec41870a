import type { Signal } from '@preact/signals';

import { studyText } from '../../text/study_text';
import { type Experience, experiences } from '../../wire/rest_types';
import { Choice, Count } from '../common/form_fields';

export interface Background {
  experience: Experience | null;
  proceduresDone: number;
}

/** How much somebody has done of the real thing. */
export function ExperienceFields({ background }: { background: Signal<Background> }) {
  const set = (change: Partial<Background>) => (background.value = { ...background.value, ...change });
  return (
    <>
      <Choice
        {...{ label: studyText.experience, testId: 'experience', required: true }}
        value={background.value.experience ?? ''}
        options={[['', ''], ...experiences.map((level) => [level, studyText.experienceNames[level]] as const)]}
        onChange={(chosen) => set({ experience: experiences.find((one) => one === chosen) ?? null })}
      />
      <Count
        {...{ label: studyText.procedures, testId: 'procedures', min: 0, max: 100000 }}
        value={background.value.proceduresDone}
        onChange={(proceduresDone) => set({ proceduresDone })}
      />
    </>
  );
}
