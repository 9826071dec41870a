/** Whether a page has changes that are not saved; null: it has none to lose. */
type Unsaved = () => boolean;

let unsaved: Unsaved | null = null;
let ask: () => boolean = () => true;

/** As long as its page is open: leaving it asks first, also where the browser's window is closed. */
export function guardUnsaved(changed: Unsaved, question: () => boolean): () => void {
  unsaved = changed;
  ask = question;
  const beforeUnload = (event: BeforeUnloadEvent) => {
    if (changed()) event.preventDefault();
  };
  window.addEventListener('beforeunload', beforeUnload);
  return () => {
    if (unsaved === changed) unsaved = null;
    window.removeEventListener('beforeunload', beforeUnload);
  };
}

/** Asks where something would be lost. */
export const mayLeave = (): boolean => unsaved === null || !unsaved() || ask();
