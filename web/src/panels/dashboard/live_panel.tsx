import { dashboardText } from '../../text/dashboard_text';
import type { LiveBoard } from '../../state/dashboard/live_board';
import { addressOfRoute } from '../../state/route';
import { clock, sentence } from '../../text/format';
import { Message } from '../common/fields';
import { LiveTile } from './live_tile';

/** What goes on now, and whether that is known. */
export function LivePanel({ board, watch }: { board: LiveBoard; watch: (id: string) => void }) {
  const tiles = board.tiles.value;
  const heardMs = board.updatedMs.value;
  const stale = board.stale.value;
  return (
    <section class="content-panel live-now" aria-labelledby="live-now-title">
      <div class="content-head">
        <h2 id="live-now-title">{dashboardText.liveNow}</h2>
        {heardMs !== null && tiles.length > 0 && (
          <span class="soft content-count" data-testid="live-count">
            {dashboardText.liveCount(tiles.length)}
          </span>
        )}
      </div>
      <News board={board} />
      {heardMs === null && board.problem.value === null && (
        <p class="soft" role="status">
          {dashboardText.loading}
        </p>
      )}
      {heardMs !== null && !stale && tiles.length === 0 && (
        <p class="soft" data-testid="none-live">
          {dashboardText.noneLive} <a href={addressOfRoute({ kind: 'live' })}>{dashboardText.startOne}</a>
        </p>
      )}
      {tiles.length > 0 && (
        <ul class="tiles" data-testid="tiles" data-stale={stale}>
          {tiles.map((tile) => (
            <LiveTile key={tile.session.id} tile={tile} old={board.isOld(tile)} watch={watch} />
          ))}
        </ul>
      )}
    </section>
  );
}

/** In words, as soon as news stop. */
function News({ board }: { board: LiveBoard }) {
  const heardMs = board.updatedMs.value;
  const problem = board.problem.value;
  if (!board.stale.value && problem === null) return null;
  return (
    <Message kind="bad" testId="no-updates">
      {`${problem === null ? '' : `${sentence(problem)} `}${
        heardMs === null ? dashboardText.neverLoaded : dashboardText.noUpdates(clock(heardMs))
      }`}
    </Message>
  );
}
