import { signal } from '@preact/signals';
import type { ComponentChildren } from 'preact';
import { useEffect } from 'preact/hooks';

import { appText } from '../../text/app_text';

/** A part of the page that is loaded when it is first wanted, and again when that failed. */
export function lazyPart<Module>(load: () => Promise<Module>) {
  const part = signal<Module | 'failed' | null>(null);

  function Part({ content }: { content: (loaded: Module) => ComponentChildren }) {
    useEffect(() => {
      if (part.value !== null && part.value !== 'failed') return;
      part.value = null;
      load().then(
        (loaded) => (part.value = loaded),
        () => (part.value = 'failed'),
      );
    }, []);
    const loaded = part.value;
    if (loaded !== null && loaded !== 'failed') return <>{content(loaded)}</>;
    return (
      <p class="page-opening" role="status">
        {loaded === null ? appText.openingPage : appText.pageNotLoaded}
      </p>
    );
  }

  return { show: (content: (loaded: Module) => ComponentChildren) => <Part content={content} /> };
}
