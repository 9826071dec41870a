/** The secret of a viewer link in the address, "#watch=SECRET", or null. */
export function linkInAddress(hash: string): string | null {
  return /^#watch=([\w-]{8,512})$/.exec(hash)?.[1] ?? null;
}

/** The address that a viewer link is sent as. */
export function addressOfLink(origin: string, secret: string): string {
  return `${origin}/#watch=${secret}`;
}

/** Takes the secret out of the address and of the history before anything else sees it. */
export function takeLinkFromAddress(): string | null {
  const secret = linkInAddress(window.location.hash);
  if (secret !== null) {
    const { pathname, search } = window.location;
    window.history.replaceState(null, '', pathname + search);
  }
  return secret;
}
