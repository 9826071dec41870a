import { useEffect } from 'preact/hooks';

import { shownName } from '../../state/page_title';

/** Names what the page shows in the title of the browser's tab, as long as the page is open. */
export function useShownName(name: string): void {
  useEffect(() => {
    shownName.value = name;
    return () => {
      if (shownName.peek() === name) shownName.value = '';
    };
  }, [name]);
}
