import type { ReviewWorkspace } from './review_workspace';

/** What keys do in a review. */
export function reviewKeys(workspace: ReviewWorkspace): Record<string, () => void> {
  const { settings } = workspace;
  const session = () => workspace.panes.peek()[settings.active.peek()]?.session;
  return {
    k: () => session()?.togglePlay(),
    ',': () => session()?.seekEvent(false),
    '.': () => session()?.seekEvent(true),
    b: () => session()?.toggleBefore(),
    d: () => session()?.nextMap(),
    e: () => (settings.measuring.value = !settings.measuring.peek()),
    t: () => (settings.slicesOpen.value = !settings.slicesOpen.peek()),
    q: () => (settings.active.value = workspace.panes.peek().length - 1 - settings.active.peek()),
  };
}
