import { useSignal } from '@preact/signals';

import { caseText } from '../../text/case_text';
import { messageOf } from '../../wire/rest';
import type { CaseController } from '../../state/case/case_controller';
import type { StepName, StepState } from '../../state/case/case_steps';
import type { Reaming } from '../../state/practice_choice';
import { Message } from '../common/fields';
import { LevelField } from '../common/level_field';
import { Button } from '../common/button';

interface Parts {
  controller: CaseController;
  states: Record<StepName, StepState>;
  reaming: Reaming;
}

/** Opens the simulator on this case, with the reamer in the user's hand. */
export function ReamStep({ controller, states, reaming }: Parts) {
  const starting = useSignal(false);
  const { store } = controller;
  const details = store.details.value;
  const lacking = (['build', 'plan'] as const).filter((name) =>
    name === 'build' ? details?.stage !== 'built' : details?.plan === null,
  );
  const outdated = (['plan', 'build'] as const).some((name) => states[name] === 'outdated');
  const start = async () => {
    starting.value = true;
    store.problem.value = null;
    try {
      await controller.landmarks.saveNow();
      await reaming.start(controller.caseId);
    } catch (error) {
      store.problem.value = messageOf(error);
    } finally {
      starting.value = false;
    }
  };
  return (
    <>
      <p class="soft">
        {lacking.length > 0
          ? caseText.reamNeeds(lacking.map((name) => caseText.steps[name].toLowerCase()).join(', '))
          : caseText.reamHint}
      </p>
      {outdated && lacking.length === 0 && <Message kind="warn">{caseText.reamOutdated}</Message>}
      <LevelField level={reaming.level} testId="case-level" />
      <div class="buttons">
        <Button
          look="main"
          testId="start-reaming"
          disabled={lacking.length > 0 || starting.value}
          onClick={() => void start()}
        >
          {starting.value ? caseText.reaming : caseText.ream}
        </Button>
      </div>
    </>
  );
}
