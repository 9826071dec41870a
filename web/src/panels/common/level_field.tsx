import type { Signal } from '@preact/signals';

import { type LevelName, levelNames } from '../../practice/level';
import { practiceText } from '../../text/practice_text';
import { SelectField } from './fields';

const options = levelNames.map((name) => [name, practiceText.levels[name]] as const);

/** How much somebody wants to be given while practising, and what that means. */
export function LevelField({ level, testId }: { level: Signal<LevelName>; testId: string }) {
  return (
    <div class="level-field">
      <SelectField
        label={practiceText.level}
        value={level.value}
        options={options}
        testId={testId}
        onChange={(name) => (level.value = name)}
      />
      <p class="soft level-hint" data-testid={`${testId}-hint`}>
        {practiceText.levelHint[level.value]}
      </p>
    </div>
  );
}
