import { useSignal } from '@preact/signals';

import { caseFileText } from '../../text/case_file_text';
import { caseText } from '../../text/case_text';
import { ctEndings } from '../../state/case/ct_file';
import type { CaseListController, NewCaseState } from '../../state/case/new_case';
import type { Side } from '../../wire/rest_types';
import { fixed, percent } from '../../text/format';
import { Message } from '../common/fields';
import { JobProgress, ProgressBar } from './job_progress';
import { Button } from '../common/button';

const accepted = [...ctEndings, '.gz'].join();
/** A file's name that begins the server's words stays as it is. */
const withStop = (words: string) => (/[.!?…]$/.test(words) ? words : `${words}.`);
const megabytes = (bytes: number) => fixed(bytes / 1e6, 1);

/** A CT's file, whose shoulder it is, and how far its upload and reading are. */
export function NewCasePanel({ controller }: { controller: CaseListController }) {
  const state = controller.state.value;
  const underWay = state.kind === 'uploading' || state.kind === 'importing';
  const file = controller.file.value;
  const side = controller.side.value;
  return (
    <aside class="new-case" aria-label={caseText.newCase}>
      <h2>{caseText.newCase}</h2>
      <FilePlace controller={controller} disabled={underWay} />
      {controller.refused.value !== null && (
        <Message kind="bad" testId="file-refused">
          {caseFileText[controller.refused.value.why](controller.refused.value.name)}
        </Message>
      )}
      <p class="soft">{caseText.newCaseHint}</p>
      <fieldset class="side-choice" disabled={underWay}>
        <legend>{caseText.whichSide}</legend>
        {(['right', 'left'] as const).map((option) => (
          <SideOption
            key={option}
            side={option}
            chosen={side === option}
            onChoose={() => (controller.side.value = option)}
          />
        ))}
      </fieldset>
      <label class="field">
        {caseText.caseName}
        <input
          type="text"
          maxLength={80}
          placeholder={caseText.caseNameHint}
          data-testid="case-name"
          disabled={underWay}
          value={controller.options.value.name}
          onInput={(event) =>
            (controller.options.value = { ...controller.options.value, name: event.currentTarget.value })
          }
        />
      </label>
      <details class="more" open={controller.options.value.seriesUid !== ''}>
        <summary>{caseText.moreChoices}</summary>
        <label class="field">
          {caseText.seriesUid}
          <input
            type="text"
            data-testid="series-uid"
            disabled={underWay}
            value={controller.options.value.seriesUid}
            onInput={(event) =>
              (controller.options.value = { ...controller.options.value, seriesUid: event.currentTarget.value })
            }
          />
        </label>
      </details>
      <Progress controller={controller} state={state} />
      {!underWay && (
        <Button
          look="main"
          testId="make-case"
          disabled={file === null || side === null}
          onClick={() => void controller.make()}
        >
          {state.kind === 'failed' && state.resumable ? caseText.goOn : caseText.make}
        </Button>
      )}
      {!underWay && file !== null && side === null && <p class="soft">{caseText.sideMustBeChosen}</p>}
    </aside>
  );
}

function SideOption({ side, chosen, onChoose }: { side: Side; chosen: boolean; onChoose: () => void }) {
  return (
    <label class={chosen ? 'side-option chosen' : 'side-option'}>
      <input type="radio" name="side" data-testid={`side-${side}`} checked={chosen} onChange={onChoose} />
      {caseText.sides[side]}
    </label>
  );
}

/** Where a file is dropped, or chosen. */
function FilePlace({ controller, disabled }: { controller: CaseListController; disabled: boolean }) {
  const over = useSignal(false);
  const file = controller.file.value;
  const take = (files: FileList | null | undefined) => {
    const first = files?.[0];
    if (first !== undefined && !disabled) controller.choose(first);
  };
  return (
    <div
      class={over.value ? 'drop over' : 'drop'}
      data-testid="drop"
      onDragOver={(event) => {
        event.preventDefault();
        over.value = !disabled;
      }}
      onDragLeave={() => (over.value = false)}
      onDrop={(event) => {
        event.preventDefault();
        over.value = false;
        take(event.dataTransfer?.files);
      }}
    >
      {file === null ? (
        <p>
          <strong>{caseText.drop}</strong> <span class="soft">{caseText.dropOr}</span>
        </p>
      ) : (
        <p data-testid="file-chosen">{caseText.fileChosen(file.name, megabytes(file.size))}</p>
      )}
      <label class={disabled ? 'plain-button disabled' : 'plain-button'}>
        {file === null ? caseText.chooseFile : caseText.chooseOther}
        <input
          type="file"
          class="visually-hidden"
          data-testid="file"
          accept={accepted}
          disabled={disabled}
          onChange={(event) => {
            take(event.currentTarget.files);
            event.currentTarget.value = '';
          }}
        />
      </label>
    </div>
  );
}

function Progress({ controller, state }: { controller: CaseListController; state: NewCaseState }) {
  switch (state.kind) {
    case 'idle':
      return null;
    case 'uploading': {
      const share = state.bytes === 0 ? 1 : state.received / state.bytes;
      const text = caseText.uploading(percent(share), megabytes(state.received), megabytes(state.bytes));
      return (
        <div class="job" role="status" data-testid="upload" data-waiting={state.waiting}>
          <p>{text}</p>
          <ProgressBar share={share} label={text} stale={state.waiting} />
          {state.waiting && <p class="warn-text">{caseText.uploadWaiting}</p>}
          <Button testId="cancel-upload" onClick={() => void controller.cancel()}>
            {caseText.cancel}
          </Button>
        </div>
      );
    }
    case 'importing':
      return (
        <JobProgress
          job={state.job}
          silent={state.silent}
          onCancel={() => void controller.cancel()}
          onDismiss={() => (controller.state.value = { kind: 'idle' })}
        />
      );
    case 'failed': {
      const during = state.resumable;
      return (
        <Message kind="bad" testId="new-case-failed">
          <strong>{during ? caseText.uploadFailed : caseText.importFailed}.</strong> {withStop(state.message)}{' '}
          {during ? caseText.uploadFailedHint : caseText.importFailedHint}
        </Message>
      );
    }
  }
}
