import type { Route } from '../../state/route';
import { appText } from '../../text/app_text';
import { SiteNav, HeaderEnd } from './site_nav';

/** The header of pages without a picture. */
export function PageHeader({ here }: { here: Route['kind'] }) {
  return (
    <header class="header">
      <h1 class="product">{appText.product}</h1>
      <SiteNav here={here} />
      <HeaderEnd />
    </header>
  );
}
