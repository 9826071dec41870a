import { useSignal } from '@preact/signals';

import { messageOf } from '../../wire/rest';
import type { ExportFormat, ReviewApi } from '../../wire/review_api';

/** Making a file of a session; `share` of it is made, null: it is not under way. */
export interface Export {
  share: number | null;
  make: () => Promise<void>;
}

/** `make` gives the file to the browser when it is done; `onProblem` gets the server's words, and null at each beginning. */
export function useExport(
  review: Pick<ReviewApi, 'exported'>,
  sessionId: string,
  format: ExportFormat,
  onProblem: (reason: string | null) => void,
): Export {
  const share = useSignal<number | null>(null);
  const make = async () => {
    share.value = 0;
    onProblem(null);
    try {
      const link = document.createElement('a');
      link.href = await review.exported(sessionId, format, (now) => (share.value = now));
      link.download = '';
      link.click();
    } catch (error) {
      onProblem(messageOf(error));
    } finally {
      share.value = null;
    }
  };
  return { share: share.value, make };
}
