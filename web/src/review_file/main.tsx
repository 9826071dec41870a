// The page of a review file: one session, all that belongs to it in this page, no server (session/export/review_file.cpp).
import 'uplot/dist/uPlot.min.css';
import '../styles/base.css';
import '../styles/forms.css';
import '../styles/outcome.css';

import { render } from 'preact';

import { theme } from '../state/theme';
import { appText } from '../text/app_text';
import { reviewText } from '../text/review_text';
import { bytesOfElement } from './file_elements';
import { ReviewFilePage } from './review_file_page';
import { readReviewParts } from './review_parts';

/** Where a browser keeps nothing for a page from disk, the theme is chosen anew each time. */
function kept(): Pick<Storage, 'getItem' | 'setItem' | 'removeItem'> {
  try {
    return window.localStorage;
  } catch {
    return { getItem: () => null, setItem: () => undefined, removeItem: () => undefined };
  }
}

async function open(root: HTMLElement): Promise<void> {
  const parts = await readReviewParts(bytesOfElement('ream-review'));
  const causes = new Blob([bytesOfElement('ream-causes')]);
  const module = new Blob([bytesOfElement('ream-twin')]);
  for (const id of ['ream-review', 'ream-causes', 'ream-twin']) document.getElementById(id)?.remove();
  const { session } = parts.facts;
  document.title = `${session.title || session.id} · ${reviewText.fileTitle} · ${appText.product}`;
  if (document.createElement('canvas').getContext('webgl2') === null) {
    root.textContent = appText.noWebGl;
    return;
  }
  root.textContent = '';
  render(<ReviewFilePage file={{ ...parts, causes, module }} />, root);
}

theme.begin(kept(), window.matchMedia('(prefers-color-scheme: dark)'), (shown) => {
  document.documentElement.dataset.theme = shown;
});
const root = document.getElementById('app');
if (root !== null) {
  root.textContent = reviewText.fileOpening;
  open(root).catch((error: unknown) => {
    console.error(error);
    root.textContent = reviewText.fileNotOpened;
  });
}
