import '../../styles/live_strip.css';

import type { ReviewWorkspace } from './review_workspace';
import { liveText } from '../../text/live_text';
import { reviewText } from '../../text/review_text';
import { ViewToggle } from '../common/view_toggle';
import { ViewTools } from '../picture/view_tools';

/** From where the bones are seen and what is seen of them, for all sessions at once. */
export function ReviewTools({ workspace }: { workspace: ReviewWorkspace }) {
  const { settings } = workspace;
  // The other is seen from where the first one is.
  const first = workspace.panes.value[0];
  if (first === undefined) return null;
  const { scene } = first.view;
  return (
    <div class="review-tools">
      <ViewTools scene={scene} view={settings.view} reamerShown={settings.reamerShown}>
        {first.liveCase !== null && (
          <ViewToggle
            id="slices"
            letter="T"
            hint={liveText.slicesHint}
            on={settings.slicesOpen.value}
            onToggle={() => (settings.slicesOpen.value = !settings.slicesOpen.peek())}
          >
            {liveText.slices}
          </ViewToggle>
        )}
        <ViewToggle
          id="measure"
          letter="E"
          hint={reviewText.measureHint}
          on={settings.measuring.value}
          onToggle={() => (settings.measuring.value = !settings.measuring.peek())}
        >
          {reviewText.measure}
        </ViewToggle>
      </ViewTools>
    </div>
  );
}
