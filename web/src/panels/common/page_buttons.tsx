import type { Paged } from '../../state/paged';
import { pageText } from '../../text/page_text';
import { Button } from './button';

/** The way from page to page of a long list; nothing where there is one page only. */
export function PageButtons({ list }: { list: Paged<{ next: string | null }> }) {
  const at = list.cursors.value.length;
  const next = list.page.value.value?.next ?? null;
  if (at === 1 && next === null) return null;
  return (
    <nav class="content-form pages" aria-label={pageText.page(at)}>
      <Button testId="previous-page" disabled={at === 1} onClick={() => void list.previous()}>
        {pageText.previousPage}
      </Button>
      <span class="soft" aria-live="polite">
        {pageText.page(at)}
      </span>
      <Button testId="next-page" disabled={next === null} onClick={() => void list.next()}>
        {pageText.nextPage}
      </Button>
    </nav>
  );
}
