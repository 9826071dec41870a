import { useSignal } from '@preact/signals';

import { type PartName, partNames, tableOf } from '../../state/study/validity_table';
import { sentence } from '../../text/format';
import { validityText } from '../../text/validity_text';
import { messageOf } from '../../wire/rest';
import type { Study, ValidityReport } from '../../wire/rest_types';
import { saveBlob } from '../../wire/save_blob';
import type { StudyApi, ValidityFile } from '../../wire/study_api';
import { Button } from '../common/button';
import { Message } from '../common/fields';
import { useIdentity } from '../common/site_nav';

const files: readonly ValidityFile[] = ['numbers', 'sessions', 'ratings', 'script'];

interface Parts {
  api: StudyApi;
  study: Study;
}

/** Whether the study's scores mean anything, and the files with which R computes it again. */
export function ValidityPanel({ api, study }: Parts) {
  const may = useIdentity().may.value;
  const report = useSignal<ValidityReport | null>(null);
  const problem = useSignal<string | null>(null);
  const busy = useSignal(false);
  const allowed = may.operate || study.state === 'closed';
  const carryOut = async (action: () => Promise<void>) => {
    busy.value = true;
    problem.value = await action().then(() => null, messageOf);
    busy.value = false;
  };
  const read = () => void carryOut(async () => void (report.value = await api.validity(study.id)));
  const save = (file: ValidityFile) =>
    void carryOut(async () => saveBlob(await api.validityFile(study.id, file), fileName(file)));
  return (
    <section class="content-panel" aria-labelledby="validity-title">
      <h2 id="validity-title">{validityText.title}</h2>
      <p class="soft">{allowed ? validityText.hint : validityText.closed}</p>
      <div class="content-form">
        <Button testId="show-validity" disabled={!allowed || busy.value} onClick={read}>
          {busy.value ? validityText.computing : report.value === null ? validityText.show : validityText.again}
        </Button>
        {files.map((file) => (
          <Button key={file} testId={`validity-${file}`} disabled={!allowed || busy.value} onClick={() => save(file)}>
            {validityText.file[file]}
          </Button>
        ))}
      </div>
      {allowed && <p class="soft">{validityText.files}</p>}
      {problem.value !== null && <Message kind="bad">{problem.value}</Message>}
      {report.value !== null && <Report report={report.value} names={itemNames(study)} />}
    </section>
  );
}

const fileName = (file: ValidityFile) => (file === 'numbers' ? 'numbers.csv' : validityText.file[file]);

/** What raters are asked, by item. */
const itemNames = (study: Study) => new Map(study.rating_form?.items.map((item) => [item.id, item.words]));

interface ReportParts {
  report: ValidityReport;
  names: ReadonlyMap<string, string>;
}

function Report({ report, names }: ReportParts) {
  const shown = partNames.filter((part) => report[part].length > 0);
  return (
    <div data-testid="validity-report">
      {report.notes.map((note) => (
        <p key={note} class="soft">
          {sentence(note)}
        </p>
      ))}
      {shown.length === 0 && <p>{validityText.empty}</p>}
      {shown.map((part) => (
        <Part key={part} {...{ report, names, part }} />
      ))}
    </div>
  );
}

function Part({ report, names, part }: ReportParts & { part: PartName }) {
  const { head, rows } = tableOf(report, part);
  const abouts = rows.some((row) => row.about !== '');
  const notes = rows.some((row) => row.notes !== '');
  const byItem = part === 'agreement' || part === 'checklist';
  return (
    <div class="table-scroll">
      <table class="data-table" data-testid={`validity-${part}`}>
        <caption>{validityText.parts[part]}</caption>
        <thead>
          <tr>
            <th scope="col">{byItem ? validityText.item : validityText.measure}</th>
            {abouts && <th scope="col">{validityText.about}</th>}
            {head.map((title) => (
              <th key={title} scope="col" class="number">
                {title}
              </th>
            ))}
            {notes && <th scope="col">{validityText.note}</th>}
          </tr>
        </thead>
        <tbody>
          {rows.map((row) => (
            <tr key={`${row.name} ${row.about}`}>
              <td>{names.get(row.name) ?? row.name}</td>
              {abouts && <td>{row.about}</td>}
              {row.cells.map((cell, i) => (
                <td key={i} class="number">
                  {cell}
                </td>
              ))}
              {notes && <td class="soft">{sentence(row.notes)}</td>}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
