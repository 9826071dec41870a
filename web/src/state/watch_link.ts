import { addressOfRoute } from './route';

/** What a viewer link's address says. */
interface LinkAddress {
  secret: string;
  /** The session whose review it leads to; null: the live page. */
  review: string | null;
}

function read(hash: string): LinkAddress | null {
  const [, secret, review = null] = /^#watch=([\w-]{8,512})(?:\/review\/([0-9a-z]{4,32}))?$/.exec(hash) ?? [];
  return secret === undefined ? null : { secret, review };
}

/** The secret of a viewer link in the address, "#watch=SECRET" or "#watch=SECRET/review/SESSION", or null. */
export function linkInAddress(hash: string): string | null {
  return read(hash)?.secret ?? null;
}

/** The address that a viewer link is sent as; it leads to the live page, or to the review of a session. */
export function addressOfLink(origin: string, secret: string, review: string | null = null): string {
  return `${origin}/#watch=${secret}${review === null ? '' : `/review/${review}`}`;
}

/** What stays in the address when the secret is taken out of it. */
export function placeBehindLink(hash: string): string {
  const review = read(hash)?.review ?? null;
  return review === null ? '' : addressOfRoute({ kind: 'review', id: review, beside: null });
}

/** Takes the secret out of the address and of the history before anything else sees it. */
export function takeLinkFromAddress(): string | null {
  const { hash, pathname, search } = window.location;
  const secret = linkInAddress(hash);
  if (secret !== null) window.history.replaceState(null, '', pathname + search + placeBehindLink(hash));
  return secret;
}
