import '../../styles/practice_chooser.css';

import { useEffect } from 'preact/hooks';

import type { PlannedReamer, PracticeChoice } from '../../state/practice_choice';
import { fixed } from '../../text/format';
import { practiceText } from '../../text/practice_text';
import { SelectField } from '../common/fields';
import { LevelField } from '../common/level_field';
import { useIdentity } from '../common/site_nav';

/** Cases may be built, and the demo prepared, while the page is open. */
const readAgainMs = 15_000;

/** What the next practice is on, and how much it gives: beside the button that starts it. */
export function PracticeChooser({ choice }: { choice: PracticeChoice }) {
  const mayRead = useIdentity().may.value.readCases;
  useEffect(() => {
    if (!mayRead) return;
    void choice.read();
    const timer = setInterval(() => void choice.read(), readAgainMs);
    const stop = choice.followReamer();
    return () => {
      clearInterval(timer);
      stop();
    };
  }, [choice, mayRead]);
  const cases = mayRead ? choice.cases.value : null;
  const reamer = choice.reamer.value;
  return (
    <div class="practice-chooser" role="group" aria-label={practiceText.chooser} data-testid="practice-chooser">
      {cases !== null && (
        <SelectField
          label={practiceText.case}
          value={choice.caseId.value}
          options={cases.map(({ id, name }) => [id, name] as const)}
          testId="practice-case"
          onChange={(id) => choice.choose(id)}
        />
      )}
      {reamer !== null && (
        <p class="soft planned-reamer" title={practiceText.reamerHint} data-testid="practice-reamer">
          {practiceText.reamer(reamerName(reamer))}
        </p>
      )}
      <LevelField level={choice.level} testId="practice-level" />
    </div>
  );
}

function reamerName(reamer: PlannedReamer): string {
  if (typeof reamer === 'string') return reamer;
  return practiceText.reamerOf(reamer.name, fixed(reamer.diameter_mm, 1));
}
