import { useEffect } from 'preact/hooks';

import { guardUnsaved } from '../../state/unsaved';

/** While the component is there, leaving the page asks `question` where something of `draft` would be lost. */
export function useUnsavedGuard<Draft>(draft: Draft, changed: (draft: Draft) => boolean, question: string): void {
  useEffect(
    () =>
      guardUnsaved(
        () => changed(draft),
        () => window.confirm(question),
      ),
    [draft],
  );
}
