import type { Route } from '../state/route';
import { words } from '../words';
import { SiteNav, WhoAmI } from './site_nav';

/** The header of pages without a picture. */
export function DeskHeader({ here }: { here: Route['kind'] }) {
  return (
    <header class="header">
      <h1 class="product">{words.product}</h1>
      <SiteNav here={here} />
      <WhoAmI />
    </header>
  );
}
