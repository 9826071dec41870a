import '../live_strip.css';

import type { ReviewDesk } from '../../pages/review_desk';
import { liveWords } from '../../live_words';
import { reviewWords } from '../../review_words';
import { ViewToggle } from '../view_toggle';
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
        <ViewToggle
          id="slices"
          letter="T"
          hint={liveWords.slicesHint}
          on={settings.slicesOpen.value}
          act={() => (settings.slicesOpen.value = !settings.slicesOpen.peek())}
        >
          {liveWords.slices}
        </ViewToggle>
        <ViewToggle
          id="measure"
          letter="E"
          hint={reviewWords.measureHint}
          on={settings.measuring.value}
          act={() => (settings.measuring.value = !settings.measuring.peek())}
        >
          {reviewWords.measure}
        </ViewToggle>
      </ViewTools>
    </div>
  );
}
