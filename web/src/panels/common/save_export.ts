import type { ExportFormat, ReviewApi } from '../../wire/review_api';

/** Makes a file of a session and gives it to the browser when it is done; throws in the server's words. */
export async function saveExport(
  review: Pick<ReviewApi, 'exported'>,
  sessionId: string,
  format: ExportFormat,
  onProgress: (share: number) => void,
): Promise<void> {
  const link = document.createElement('a');
  link.href = await review.exported(sessionId, format, onProgress);
  link.download = '';
  link.click();
}
