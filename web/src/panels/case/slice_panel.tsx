import type { Signal } from '@preact/signals';
import { useEffect, useRef, useState } from 'preact/hooks';

import { caseText } from '../../text/case_text';
import type { PlaneName } from '../../ct/orientation';
import { planeColours, type SliceView } from '../../scene/slice_view';
import type { CaseStore } from '../../state/case/case_store';

export type ViewId = PlaneName | 'surface';

interface Parts {
  name: PlaneName;
  view: SliceView;
  store: CaseStore;
  enlarged: Signal<ViewId | null>;
}

/** One slice view with its name, place, and the letters of the patient's directions at its edges. */
export function SlicePanel({ name, view, store, enlarged }: Parts) {
  const place = useRef<HTMLDivElement>(null);
  const title = caseText.planes[name];
  useEffect(() => {
    const { canvas } = view;
    canvas.setAttribute('role', 'application');
    canvas.setAttribute('aria-label', caseText.sliceLabel(title));
    canvas.dataset.testid = `slice-${name}`;
    place.current?.prepend(canvas);
    return () => canvas.remove();
  }, [view, name, title]);
  const at = view.place.value;
  const letters = store.planes.value?.[name].letters;
  const late = useLate(view.pending.value);
  const problem = view.problem.value;
  return (
    <section class={late ? 'view late' : 'view'} aria-label={title} style={{ '--plane': planeColours[name] }}>
      <ViewHead id={name} title={title} enlarged={enlarged}>
        {at !== null && (
          <span
            class="view-place"
            data-testid={`place-${name}`}
            data-index={at.index}
            data-pending={view.pending.value}
          >
            {caseText.sliceOf(at.index, at.count)}
          </span>
        )}
      </ViewHead>
      <div class="view-canvas" ref={place}>
        {letters !== undefined &&
          (['left', 'right', 'top', 'bottom'] as const).map((edge) => (
            <span
              key={edge}
              class={`edge edge-${edge}`}
              data-testid={`edge-${name}-${edge}`}
              role="img"
              aria-label={caseText.edge(letters[edge])}
            >
              {letters[edge]}
            </span>
          ))}
        {(late || problem !== null) && (
          <p class="view-note" role="status">
            {problem === null ? caseText.sliceLoading : caseText.sliceFailed(problem)}
          </p>
        )}
      </div>
    </section>
  );
}

interface HeadParts {
  id: ViewId;
  title: string;
  /** Null where there is but one view. */
  enlarged: Signal<ViewId | null> | null;
  children?: preact.ComponentChildren;
}

export function ViewHead({ id, title, enlarged, children }: HeadParts) {
  return (
    <header class="view-head">
      <h2>{title}</h2>
      {children}
      {enlarged !== null && <EnlargeButton id={id} title={title} enlarged={enlarged} />}
    </header>
  );
}

function EnlargeButton({ id, title, enlarged }: { id: ViewId; title: string; enlarged: Signal<ViewId | null> }) {
  const large = enlarged.value === id;
  const label = large ? caseText.reduce : caseText.enlarge(title);
  return (
    <button
      type="button"
      class="enlarge"
      data-testid={`enlarge-${id}`}
      aria-pressed={large}
      aria-label={label}
      title={label}
      onClick={() => (enlarged.value = large ? null : id)}
    >
      {large ? '⤡' : '⤢'}
    </button>
  );
}

const lateAfterMs = 250;

/** Whether something has been pending long enough to be worth saying. */
function useLate(pending: boolean): boolean {
  const [late, setLate] = useState(false);
  useEffect(() => {
    if (!pending) {
      setLate(false);
      return;
    }
    const timer = setTimeout(() => setLate(true), lateAfterMs);
    return () => clearTimeout(timer);
  }, [pending]);
  return late;
}
