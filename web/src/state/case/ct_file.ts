/** Endings of files that the server reads as a CT. */
export const ctEndings = ['.zip', '.nrrd', '.nii', '.nii.gz', '.mha', '.txt', '.dcm'] as const;

export interface RefusedFile {
  name: string;
  why: 'notACt' | 'empty';
}

/** Why a file cannot become a case, known before anything is sent; null where it may. */
export function refusedFile({ name, size }: { name: string; size: number }): RefusedFile | null {
  const lower = name.toLowerCase();
  if (!ctEndings.some((ending) => lower.endsWith(ending))) return { name, why: 'notACt' };
  return size === 0 ? { name, why: 'empty' } : null;
}
