import type { ComponentChildren } from 'preact';

interface Parts {
  label: string;
  /** Unique on the page. */
  id: string;
  fault: string | undefined;
  children: (described: {
    id: string;
    'aria-invalid': boolean;
    'aria-describedby': string | undefined;
  }) => ComponentChildren;
}

/** A field with its label, and what is wrong with it beside it. */
export function FaultField({ label, id, fault, children }: Parts) {
  const faultId = `${id}-fault`;
  const bad = fault !== undefined;
  return (
    <span class={bad ? 'fault-field fault-field-bad' : 'fault-field'}>
      <label for={id}>{label}</label>
      {children({ id, 'aria-invalid': bad, 'aria-describedby': bad ? faultId : undefined })}
      {bad && <Fault id={faultId} words={fault} />}
    </span>
  );
}

export function Fault({ id, words }: { id: string; words: string }) {
  return (
    <span class="field-fault" id={id} data-testid={id}>
      {words}
    </span>
  );
}

interface NumberParts {
  label: string;
  id: string;
  fault: string | undefined;
  value: string;
  onInput: (value: string) => void;
}

/** A number that may be missing while it is typed. */
export function NumberLine({ label, id, fault, value, onInput }: NumberParts) {
  return (
    <FaultField {...{ label, id, fault }}>
      {(described) => (
        <input
          type="number"
          step="any"
          {...described}
          data-testid={id}
          value={value}
          onInput={(event) => onInput(event.currentTarget.value)}
        />
      )}
    </FaultField>
  );
}
