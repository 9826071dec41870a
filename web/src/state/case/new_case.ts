import { batch, signal } from '@preact/signals';

import type { CaseApi } from '../../wire/case_api';
import type { CaseSummary, Job, Side } from '../../wire/rest_types';
import { ApiError, messageOf } from '../../wire/rest';
import { CasePlans } from './case_plans';
import { type RefusedFile, refusedFile } from './ct_file';
import { followJob, pause } from './job_watch';
import { dropUpload, forgetUpload, uploadFile, type UploadSource } from './upload';

/**
 * - idle: a file is to be chosen, or what is missing be filled in
 * - uploading; waiting: the link is broken and is tried again
 * - importing: the server reads the file
 * - failed: words say why; what was uploaded is kept, so that the next try goes on from there
 */
export type NewCaseState =
  | { kind: 'idle' }
  | { kind: 'uploading'; received: number; bytes: number; waiting: boolean }
  | { kind: 'importing'; job: Job; silent: boolean }
  | { kind: 'failed'; during: 'upload' | 'import'; message: string; resumable: boolean };

export interface NewCaseOptions {
  name: string;
  seriesUid: string;
}

/** All cases, and the making of a new one from a file; lives as long as the page is open. */
export class CaseListController {
  readonly cases = signal<readonly CaseSummary[] | null>(null);
  /** Whether the list was read since the page of cases was opened. */
  readonly listFresh = signal(false);
  readonly listProblem = signal<string | null>(null);
  readonly file = signal<UploadSource | null>(null);
  /** Why the file that was chosen last cannot be used. */
  readonly refused = signal<RefusedFile | null>(null);
  /** Never guessed: the user says which shoulder it is. */
  readonly side = signal<Side | null>(null);
  readonly options = signal<NewCaseOptions>({ name: '', seriesUid: '' });
  readonly state = signal<NewCaseState>({ kind: 'idle' });
  readonly plans: CasePlans;
  private abort = new AbortController();

  constructor(
    readonly api: CaseApi,
    readonly remembered: Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>,
    /** The new case can be worked on. */
    private readonly onReady: (caseId: string) => void,
  ) {
    this.plans = new CasePlans(api);
  }

  async readCases(): Promise<void> {
    try {
      const cases = await this.api.cases();
      batch(() => {
        this.cases.value = cases;
        this.listFresh.value = true;
        this.listProblem.value = null;
      });
      void this.plans.read(cases);
    } catch (error) {
      this.listProblem.value = messageOf(error);
    }
  }

  /** A file that can never become a case is refused at once, in words; what was chosen before stays. */
  choose(file: UploadSource): void {
    this.refused.value = refusedFile(file);
    if (this.refused.value !== null) return;
    this.file.value = file;
    this.state.value = { kind: 'idle' };
  }

  async remove(id: string): Promise<void> {
    try {
      await this.api.remove(id);
    } catch (error) {
      this.listProblem.value = messageOf(error);
      return;
    }
    await this.readCases();
  }

  /** Uploads the chosen file and has it read; also goes on after a failure. */
  async make(): Promise<void> {
    const file = this.file.value;
    const side = this.side.value;
    if (file === null || side === null) return;
    this.abort = new AbortController();
    const { signal } = this.abort;
    let during: 'upload' | 'import' = 'upload';
    try {
      const uploadId = await this.upload(file, signal);
      during = 'import';
      const { name, seriesUid } = this.options.value;
      const first = await this.api.importCase({
        upload_id: uploadId,
        side,
        ...(name.trim() === '' ? {} : { name: name.trim() }),
        ...(seriesUid.trim() === '' ? {} : { series_uid: seriesUid.trim() }),
      });
      // The server uses an upload once.
      forgetUpload(file, this.remembered);
      const job = await this.follow(first, signal);
      if (job?.state === 'done') {
        batch(() => {
          this.file.value = null;
          this.side.value = null;
          this.options.value = { name: '', seriesUid: '' };
          this.state.value = { kind: 'idle' };
        });
        if (job.case_id !== null) this.onReady(job.case_id);
      } else if (job?.state === 'failed') {
        const message = job.problem?.detail ?? job.problem?.title ?? job.step;
        this.state.value = { kind: 'failed', during, message, resumable: false };
      } else {
        this.state.value = { kind: 'idle' };
      }
      await this.readCases();
    } catch (error) {
      if (signal.aborted) await dropUpload(file, this);
      this.state.value = signal.aborted
        ? { kind: 'idle' }
        : { kind: 'failed', during, message: messageOf(error), resumable: during === 'upload' && canPass(error) };
    }
  }

  /** Ends the upload, or asks the server to end the import. */
  async cancel(): Promise<void> {
    const state = this.state.value;
    if (state.kind === 'uploading') this.abort.abort();
    if (state.kind === 'importing') await this.api.cancel(state.job.id).catch(() => undefined);
  }

  private async upload(file: UploadSource, signal: AbortSignal): Promise<string> {
    this.state.value = { kind: 'uploading', received: 0, bytes: file.size, waiting: false };
    const reportProgress = (change: { received?: number; waiting?: boolean }) => {
      const state = this.state.value;
      if (state.kind === 'uploading') this.state.value = { ...state, ...change };
    };
    const upload = await uploadFile(
      file,
      {
        api: this.api,
        remembered: this.remembered,
        onProgress: (received) => reportProgress({ received }),
        onWaiting: (waiting) => reportProgress({ waiting }),
        pause,
      },
      signal,
    );
    return upload.id;
  }

  private follow(first: Job, signal: AbortSignal): Promise<Job | null> {
    let silent = false;
    return followJob(
      first,
      {
        api: this.api,
        onJob: (job) => (this.state.value = { kind: 'importing', job, silent }),
        onSilence: (now) => {
          silent = now;
          const state = this.state.value;
          if (state.kind === 'importing') this.state.value = { ...state, silent };
        },
        pause,
      },
      signal,
    );
  }
}

/** Whether another try may succeed: a link or server that fails, unlike a refusal of the file. */
function canPass(error: unknown): boolean {
  return !(error instanceof ApiError) || error.status === 0 || error.status === 409 || error.status >= 500;
}
