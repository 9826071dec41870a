import '../styles/review.css';

import { useEffect, useMemo } from 'preact/hooks';

import { PageHeader } from '../panels/common/page_header';
import { useLiveKeys } from '../panels/picture/live_keys';
import { ComparePanel } from '../panels/review/compare_panel';
import { FactsPanel } from '../panels/review/facts_panel';
import { FilesPanel } from '../panels/review/files_panel';
import { KeysPanel } from '../panels/review/keys_panel';
import { MapPanel } from '../panels/review/map_panel';
import { MeasurePanel } from '../panels/review/measure_panel';
import { ReviewPane } from '../panels/review/review_pane';
import { ReviewTools } from '../panels/review/review_tools';
import { ScorePanel } from '../panels/review/score_panel';
import { VerificationPanel } from '../panels/review/verification_panel';
import { useIdentity } from '../panels/common/site_nav';
import { useShownName } from '../panels/common/use_shown_name';
import type { Route } from '../state/route';
import { ReviewWorkspace } from '../panels/review/review_workspace';

/** One session after its end, or two beside each other. */
export function ReviewPage({ route }: { route: Route & { kind: 'review' } }) {
  const identity = useIdentity();
  const may = identity.may.value;
  const workspace = useMemo(() => new ReviewWorkspace(window.location.origin, may), [may]);
  useEffect(() => () => workspace.dispose(), [workspace]);
  useEffect(() => {
    workspace.show(route.beside === null ? [route.id] : [route.id, route.beside]);
  }, [workspace, route.id, route.beside]);
  const person = identity.userId.value ?? 'anyone';
  useEffect(() => workspace.settings.view.keepFor(`${person}.review`, window.localStorage), [workspace, person]);
  useLiveKeys(useMemo(() => keysOf(workspace), [workspace]));
  const panes = workspace.panes.value;
  const first = panes[0]?.session;
  useShownName(first?.details.value?.title || (first?.id ?? ''));
  return (
    <div class={`page review-page review-of-${panes.length}`}>
      <PageHeader here="review" />
      <main class="review-main">
        <div class="review-panes">
          {panes.map((pane, i) => (
            <ReviewPane key={pane.session.id + String(i)} pane={pane} place={i} workspace={workspace} />
          ))}
        </div>
        <ReviewTools workspace={workspace} />
      </main>
      <aside class="side review-side">
        <FactsPanel panes={panes} />
        <MeasurePanel workspace={workspace} />
        <MapPanel workspace={workspace} />
        <ScorePanel panes={panes} />
        {panes.map(({ session }, i) => (
          <FilesPanel key={session.id + String(i)} session={session} review={workspace.review} />
        ))}
        {may.ream &&
          panes.map(({ session }, i) => (
            <VerificationPanel key={session.id + String(i)} session={session} review={workspace.review} />
          ))}
        <ComparePanel panes={panes} />
        <KeysPanel />
      </aside>
    </div>
  );
}

function keysOf(workspace: ReviewWorkspace): Record<string, () => void> {
  const { settings } = workspace;
  const session = () => workspace.panes.peek()[settings.active.peek()]?.session;
  return {
    k: () => session()?.togglePlay(),
    ',': () => session()?.seekEvent(false),
    '.': () => session()?.seekEvent(true),
    b: () => session()?.toggleBefore(),
    d: () => session()?.nextMap(),
    e: () => (settings.measuring.value = !settings.measuring.peek()),
    t: () => (settings.slicesOpen.value = !settings.slicesOpen.peek()),
    q: () => (settings.active.value = workspace.panes.peek().length - 1 - settings.active.peek()),
  };
}
