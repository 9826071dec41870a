import { useSignal } from '@preact/signals';

import { caseWords } from '../../case_words';
import { liveWords } from '../../live_words';
import { type CaseKeeper, wordsOf } from '../../state/case/case_keeper';
import type { StepName, StepState } from '../../state/case/case_steps';
import { CheckField, Remark } from '../fields';

interface Parts {
  keeper: CaseKeeper;
  states: Record<StepName, StepState>;
  startReaming: (caseId: string, theatre: boolean) => Promise<void>;
}

/** Opens the simulator on this case, with the reamer in the user's hand. */
export function ReamStep({ keeper, states, startReaming }: Parts) {
  const starting = useSignal(false);
  const theatre = useSignal(false);
  const { store } = keeper;
  const details = store.details.value;
  const lacking = (['build', 'plan'] as const).filter((name) =>
    name === 'build' ? details?.stage !== 'built' : details?.plan === null,
  );
  const outdated = (['plan', 'build'] as const).some((name) => states[name] === 'outdated');
  const start = async () => {
    starting.value = true;
    store.problem.value = null;
    try {
      await keeper.landmarks.saveNow();
      await startReaming(keeper.caseId, theatre.value);
    } catch (error) {
      store.problem.value = wordsOf(error);
    } finally {
      starting.value = false;
    }
  };
  return (
    <>
      <p class="soft">
        {lacking.length > 0
          ? caseWords.reamNeeds(lacking.map((name) => caseWords.steps[name].toLowerCase()).join(', '))
          : caseWords.reamHint}
      </p>
      {outdated && lacking.length === 0 && <Remark kind="warn">{caseWords.reamOutdated}</Remark>}
      <CheckField
        label={liveWords.theatreMode}
        hint={liveWords.theatreHint}
        checked={theatre.value}
        testId="case-theatre"
        onChange={(wanted) => (theatre.value = wanted)}
      />
      <div class="buttons">
        <button
          type="button"
          class="main-button"
          data-testid="start-reaming"
          disabled={lacking.length > 0 || starting.value}
          onClick={() => void start()}
        >
          {starting.value ? caseWords.reaming : caseWords.ream}
        </button>
      </div>
    </>
  );
}
