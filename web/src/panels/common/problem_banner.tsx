import type { Store } from '../../state/store';
import { appText } from '../../text/app_text';
import { sentence } from '../../text/format';

/** What went wrong at the user's hand, until dismissed. */
export function ProblemBanner({ store }: { store: Store }) {
  const problem = store.problem.value;
  if (problem === null) return null;
  return (
    <div class="problem" role="alert" data-testid="problem">
      <p>
        <strong>{appText.problem}.</strong> {sentence(problem)}
      </p>
      <button type="button" onClick={() => (store.problem.value = null)}>
        {appText.dismiss}
      </button>
    </div>
  );
}
