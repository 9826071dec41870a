import { useSignal } from '@preact/signals';

import { feelRow, type FeelRow } from '../../state/study/feel_table';
import { feelText } from '../../text/feel_text';
import { sentence } from '../../text/format';
import { messageOf } from '../../wire/rest';
import type { FeelReport, Study } from '../../wire/rest_types';
import { saveBlob } from '../../wire/save_blob';
import type { StudyApi } from '../../wire/study_api';
import { Button } from '../common/button';
import { Message } from '../common/fields';
import { useIdentity } from '../common/site_nav';

interface Parts {
  api: StudyApi;
  study: Study;
}

/** How often participants of a blind study of feel were right, beside what is published. */
export function FeelReportPanel({ api, study }: Parts) {
  const may = useIdentity().may.value;
  const report = useSignal<FeelReport | null>(null);
  const problem = useSignal<string | null>(null);
  const busy = useSignal(false);
  const allowed = may.operate || study.state === 'closed';
  const carryOut = async (action: () => Promise<void>) => {
    busy.value = true;
    problem.value = await action().then(() => null, messageOf);
    busy.value = false;
  };
  const read = () => void carryOut(async () => void (report.value = await api.feelReport(study.id)));
  const save = () =>
    void carryOut(async () => saveBlob(await api.feelAnswers(study.id), `${study.id}-feel-answers.csv`));
  return (
    <section class="content-panel" aria-labelledby="feel-report-title">
      <h2 id="feel-report-title">{feelText.report}</h2>
      <p class="soft">{allowed ? feelText.reportHint : feelText.reportClosed}</p>
      <div class="content-form">
        <Button testId="show-feel-report" disabled={!allowed || busy.value} onClick={read}>
          {busy.value ? feelText.computing : report.value === null ? feelText.show : feelText.again}
        </Button>
        <Button testId="feel-answers-csv" disabled={!allowed || busy.value} onClick={save}>
          {feelText.csv}
        </Button>
      </div>
      {problem.value !== null && (
        <Message kind="bad" testId="feel-report-problem">
          {problem.value}
        </Message>
      )}
      {report.value !== null && <Report report={report.value} />}
    </section>
  );
}

function Report({ report: { participants, lines } }: { report: FeelReport }) {
  const rows = lines.map(feelRow);
  const notes = rows.some(({ note }) => note !== '');
  return (
    <div data-testid="feel-report">
      <p class="soft feel-count">{participants === 0 ? feelText.nobody : feelText.answered(participants)}</p>
      <div class="table-scroll" role="region" aria-label={feelText.report} tabIndex={0}>
        <table class="data-table feel-report">
          <Head notes={notes} />
          <tbody>
            {rows.map((row) => (
              <Row key={row.comparison} row={row} notes={notes} />
            ))}
          </tbody>
        </table>
      </div>
    </div>
  );
}

function Head({ notes }: { notes: boolean }) {
  const { question, participants, right, sd, p, dPrime, published, note } = feelText.columns;
  return (
    <thead>
      <tr>
        <th scope="col">{question}</th>
        {[participants, right, sd, p, dPrime].map((title) => (
          <th key={title} scope="col" class="number">
            {title}
          </th>
        ))}
        <th scope="col">{published}</th>
        {notes && <th scope="col">{note}</th>}
      </tr>
    </thead>
  );
}

function Row({ row, notes }: { row: FeelRow; notes: boolean }) {
  return (
    <tr data-testid={`feel-line-${row.comparison}`}>
      <td>{row.question}</td>
      {[row.participants, row.right, row.sd, row.p, row.dPrime].map((cell, i) => (
        <td key={i} class="number">
          {cell}
        </td>
      ))}
      <td>
        {row.published?.share} {row.published !== null && <span class="soft">{row.published.source}</span>}
      </td>
      {notes && <td class="soft">{sentence(row.note)}</td>}
    </tr>
  );
}
