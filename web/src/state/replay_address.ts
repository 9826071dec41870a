/** The replay that a page's address names, as "#replay=ID", or null. */
export function replayInAddress(hash: string): string | null {
  return /^#replay=([0-9a-z]{4,32})$/.exec(hash)?.[1] ?? null;
}

/** The part of the address that names a replay, so that it can be sent to others; empty for none. */
export function addressOfReplay(replayId: string | null): string {
  return replayId === null ? '' : `#replay=${replayId}`;
}
