import { caseFileText } from '../../text/case_file_text';

/** Endings of files that the server reads as a CT. */
export const ctEndings = ['.zip', '.nrrd', '.nii', '.nii.gz', '.mha', '.txt', '.dcm'] as const;

/** Why a file cannot become a case, known before anything is sent; null where it may. */
export function refusedFile({ name, size }: { name: string; size: number }): string | null {
  const lower = name.toLowerCase();
  if (!ctEndings.some((ending) => lower.endsWith(ending))) return caseFileText.notACt(name);
  return size === 0 ? caseFileText.empty(name) : null;
}
