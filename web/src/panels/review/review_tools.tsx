import '../live_strip.css';

import type { ReviewDesk } from '../../pages/review_desk';
import { liveWords } from '../../live_words';
import { reviewWords } from '../../review_words';
import { ViewTools } from '../view_tools';

/** From where the bones are seen and what is seen of them, for all sessions at once. */
export function ReviewTools({ desk }: { desk: ReviewDesk }) {
  const { settings } = desk;
  // The other is seen from where the first one is.
  const scene = desk.panes.value[0]?.view.scene;
  if (scene === undefined) return null;
  return (
    <div class="review-tools">
      <ViewTools scene={scene} view={settings.view} reamerShown={settings.reamerShown}>
        <Toggle
          id="slices"
          letter="T"
          hint={liveWords.slicesHint}
          on={settings.slicesOpen.value}
          act={() => (settings.slicesOpen.value = !settings.slicesOpen.peek())}
        >
          {liveWords.slices}
        </Toggle>
        <Toggle
          id="measure"
          letter="E"
          hint={reviewWords.measureHint}
          on={settings.measuring.value}
          act={() => (settings.measuring.value = !settings.measuring.peek())}
        >
          {reviewWords.measure}
        </Toggle>
      </ViewTools>
    </div>
  );
}

interface ToggleParts {
  id: string;
  letter: string;
  hint: string;
  on: boolean;
  act: () => void;
  children: string;
}

function Toggle({ id, letter, hint, on, act, children }: ToggleParts) {
  return (
    <button
      type="button"
      class={on ? 'tool-on' : ''}
      data-testid={id}
      aria-pressed={on}
      aria-keyshortcuts={letter}
      title={liveWords.key(hint, letter)}
      onClick={act}
    >
      {children}
    </button>
  );
}
