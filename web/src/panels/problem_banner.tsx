import type { Store } from '../state/store';
import { words } from '../words';
import { sentence } from './format';

/** What went wrong at the user's hand, until dismissed. */
export function ProblemBanner({ store }: { store: Store }) {
  const problem = store.problem.value;
  if (problem === null) return null;
  return (
    <div class="problem" role="alert" data-testid="problem">
      <p>
        <strong>{words.problem}.</strong> {sentence(problem)}
      </p>
      <button type="button" onClick={() => (store.problem.value = null)}>
        {words.dismiss}
      </button>
    </div>
  );
}
