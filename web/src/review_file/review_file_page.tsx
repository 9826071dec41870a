import '../styles/review.css';

import { useEffect, useMemo } from 'preact/hooks';

import { ThemeButton } from '../panels/common/theme_button';
import { useLiveKeys } from '../panels/picture/live_keys';
import { FactsPanel } from '../panels/review/facts_panel';
import { KeysPanel } from '../panels/review/keys_panel';
import { MapPanel } from '../panels/review/map_panel';
import { MeasurePanel } from '../panels/review/measure_panel';
import { reviewKeys } from '../panels/review/review_keys';
import { ReviewPane } from '../panels/review/review_pane';
import { ReviewTools } from '../panels/review/review_tools';
import { ReviewWorkspace } from '../panels/review/review_workspace';
import { ScorePanel } from '../panels/review/score_panel';
import { VerificationPanel } from '../panels/review/verification_panel';
import { appText } from '../text/app_text';
import { reviewText } from '../text/review_text';
import { fileSources, fileVerification, type ReviewFile } from './file_sources';

/** The session that this page itself holds. */
export function ReviewFilePage({ file }: { file: ReviewFile }) {
  const { session, program } = file.facts;
  const workspace = useMemo(
    () => new ReviewWorkspace(() => fileSources(file), { served: false, mayAnnotate: false }),
    [file],
  );
  const verification = useMemo(() => fileVerification(file), [file]);
  useEffect(() => {
    workspace.show([session.id]);
    return () => workspace.dispose();
  }, [workspace, session.id]);
  useLiveKeys(useMemo(() => reviewKeys(workspace), [workspace]));
  const panes = workspace.panes.value;
  return (
    <div class="page review-page review-of-1">
      <header class="header">
        <h1 class="product">{appText.product}</h1>
        <p class="soft">{reviewText.fileHint}</p>
        <div class="header-end">
          <ThemeButton />
        </div>
      </header>
      <main class="review-main">
        <div class="review-panes">
          {panes.map((pane) => (
            <ReviewPane key={pane.session.id} pane={pane} place={0} workspace={workspace} />
          ))}
        </div>
        <ReviewTools workspace={workspace} />
      </main>
      <aside class="side review-side">
        <FactsPanel panes={panes} />
        {panes.map((pane) => (
          <VerificationPanel key={pane.session.id} session={pane.session} sources={verification} atOnce />
        ))}
        <MeasurePanel workspace={workspace} />
        <MapPanel workspace={workspace} />
        <ScorePanel panes={panes} />
        <KeysPanel served={false} />
        <p class="soft" data-testid="made-by">
          {reviewText.fileMadeBy(program)}
        </p>
      </aside>
    </div>
  );
}
