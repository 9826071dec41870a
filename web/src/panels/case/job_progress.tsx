import { caseText } from '../../text/case_text';
import { percent } from '../../text/format';
import { isUnderWay } from '../../state/case/job_watch';
import type { Job } from '../../wire/rest_types';

interface Parts {
  job: Job;
  /** The server does not answer. */
  silent: boolean;
  onCancel: () => void;
  onDismiss: () => void;
}

/** How far long work is, in words and as a bar; why it ended, where it did not end well. */
export function JobProgress({ job, silent, onCancel, onDismiss }: Parts) {
  const underWay = isUnderWay(job);
  const failed = job.state === 'failed';
  const why = job.problem?.detail ?? job.problem?.title ?? '';
  return (
    <div
      class={failed ? 'job job-failed' : 'job'}
      role={failed ? 'alert' : 'status'}
      data-testid="job"
      data-state={job.state}
    >
      <p>
        <strong>{caseText.jobKind(job.kind)}.</strong> {caseText.jobState(job)}
        {failed && `: ${why}`}
      </p>
      {underWay && <ProgressBar share={job.share} label={caseText.jobKind(job.kind)} stale={silent} />}
      {underWay && silent && <p class="warn-text">{caseText.jobSilent}</p>}
      <button type="button" class="plain-button" data-testid="cancel-job" onClick={underWay ? onCancel : onDismiss}>
        {underWay ? caseText.cancel : caseText.dismiss}
      </button>
    </div>
  );
}

export function ProgressBar({ share, label, stale }: { share: number; label: string; stale: boolean }) {
  return (
    <div
      class={stale ? 'progress stale' : 'progress'}
      role="progressbar"
      aria-label={label}
      aria-valuemin={0}
      aria-valuemax={100}
      aria-valuenow={parseInt(percent(share), 10)}
    >
      <div style={{ width: `${share * 100}%` }} />
      <span>{percent(share)}</span>
    </div>
  );
}
