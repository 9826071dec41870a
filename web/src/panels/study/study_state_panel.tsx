import type { Remote } from '../../state/remote';
import { studyText } from '../../text/study_text';
import type { StudyApi } from '../../wire/study_api';
import type { Study } from '../../wire/rest_types';
import { saveBlob } from '../../wire/save_blob';
import { ConfirmButton } from '../common/confirm_dialog';
import { useIdentity } from '../common/site_nav';
import { Button } from '../common/button';

interface Parts {
  api: StudyApi;
  study: Study;
  studies: Remote<Study>;
  /** Nobody takes part. */
  empty: boolean;
  onRemoved: () => void;
}

/** Closing, unblinding and deleting a study, and what is taken out of it. */
export function StudyStatePanel({ api, study, studies, empty, onRemoved }: Parts) {
  const may = useIdentity().may.value;
  const busy = studies.busy.value;
  const act = (action: () => Promise<unknown>) => void studies.act(action);
  const remove = async () => {
    if ((await studies.act(() => api.remove(study.id))) !== null) onRemoved();
  };
  const closed = study.state === 'closed';
  const confirmButtons = { no: studyText.no, disabled: busy };
  return (
    <div class="content-head study-actions">
      {!closed && (
        <ConfirmButton
          label={studyText.close}
          question={studyText.closeConfirm}
          yes={studyText.closeYes}
          testId="close-study"
          {...confirmButtons}
          onYes={() => act(() => api.close(study.id))}
        />
      )}
      {closed && study.blinded && (
        <Button testId="reopen-study" disabled={busy} onClick={() => act(() => api.reopen(study.id))}>
          {studyText.reopen}
        </Button>
      )}
      {closed && study.blinded && may.operate && (
        <ConfirmButton
          label={studyText.unblind}
          question={studyText.unblindConfirm}
          yes={studyText.unblind}
          testId="unblind-study"
          {...confirmButtons}
          onYes={() => act(() => api.unblind(study.id))}
        />
      )}
      {may.operate && empty && (
        <ConfirmButton
          label={studyText.remove}
          question={studyText.removeConfirm}
          yes={studyText.remove}
          testId="remove-study"
          {...confirmButtons}
          onYes={() => void remove()}
        />
      )}
    </div>
  );
}

const tables = [
  ['sessions', studyText.exportSessions],
  ['answers', studyText.exportAnswers],
  ['groups', studyText.exportGroups],
  ['ratings', studyText.exportRatings],
  ['json', studyText.exportAll],
] as const;

/** The study's data for statistics. */
export function ExportPanel({ api, study, studies }: Pick<Parts, 'api' | 'study' | 'studies'>) {
  const may = useIdentity().may.value;
  const allowed = may.operate || study.state === 'closed';
  // Nobody rates a study of feel.
  const shown = tables.filter(([table]) => table !== 'ratings' || !study.feel);
  const save = (name: string, get: () => Promise<Blob>) =>
    void studies.act(async () => saveBlob(await get(), `${study.id}-${name}`));
  return (
    <section class="content-panel" aria-labelledby="export-title">
      <h2 id="export-title">{studyText.exports}</h2>
      <p class="soft">{allowed ? studyText.exportHint : studyText.exportClosed}</p>
      <div class="content-form">
        {shown.map(([table, label]) => (
          <button
            key={table}
            type="button"
            class="plain-button"
            data-testid={`export-${table}`}
            disabled={!allowed || studies.busy.value}
            onClick={() => save(table === 'json' ? 'export.json' : `${table}.csv`, () => api.export(study.id, table))}
          >
            {label}
          </button>
        ))}
        <Button
          testId="export-codebook"
          disabled={studies.busy.value}
          onClick={() => save('codebook.json', () => api.codebook(study.id))}
        >
          {studyText.exportCodebook}
        </Button>
      </div>
    </section>
  );
}
