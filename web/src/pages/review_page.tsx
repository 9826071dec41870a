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
import type { ReviewSession } from '../state/review/review_session';
import type { Route } from '../state/route';
import { ReviewWorkspace } from '../panels/review/review_workspace';
import { reviewKeys } from '../panels/review/review_keys';
import { servedSources } from '../panels/review/served_sources';
import { servedVerification } from '../panels/review/served_verification';
import { ReviewApi } from '../wire/review_api';

/** One session after its end, or two beside each other. */
export function ReviewPage({ route }: { route: Route & { kind: 'review' } }) {
  const identity = useIdentity();
  const may = identity.may.value;
  const { origin } = window.location;
  const review = useMemo(() => new ReviewApi(origin), [origin]);
  const workspace = useMemo(
    () => new ReviewWorkspace(() => servedSources(origin, review, may), { served: true, mayAnnotate: may.ream }),
    [origin, review, may],
  );
  useEffect(() => () => workspace.dispose(), [workspace]);
  useEffect(() => {
    workspace.show(route.beside === null ? [route.id] : [route.id, route.beside]);
  }, [workspace, route.id, route.beside]);
  const person = identity.userId.value ?? 'anyone';
  useEffect(() => workspace.settings.view.keepFor(`${person}.review`, window.localStorage), [workspace, person]);
  useLiveKeys(useMemo(() => reviewKeys(workspace), [workspace]));
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
          <FilesPanel key={session.id + String(i)} session={session} review={review} />
        ))}
        {may.ream &&
          panes.map(({ session }, i) => (
            <ServedVerification key={session.id + String(i)} session={session} review={review} />
          ))}
        <ComparePanel panes={panes} />
        <KeysPanel />
      </aside>
    </div>
  );
}

function ServedVerification({ session, review }: { session: ReviewSession; review: ReviewApi }) {
  const sources = useMemo(() => servedVerification(review, session.id), [review, session.id]);
  return <VerificationPanel session={session} sources={sources} />;
}
