interface ChoiceParts {
  label: string;
  testId: string;
  value: string;
  /** Values and their words. */
  options: readonly (readonly [value: string, words: string])[];
  required?: boolean;
  onChange: (value: string) => void;
}

/** One of some values, in a form. */
export function Choice({ label, testId, value, options, required, onChange }: ChoiceParts) {
  return (
    <label>
      {label}
      <select
        required={required}
        data-testid={testId}
        value={value}
        onChange={(event) => onChange(event.currentTarget.value)}
      >
        {options.map(([id, label]) => (
          <option key={id} value={id}>
            {label}
          </option>
        ))}
      </select>
    </label>
  );
}

interface TextLineParts {
  label: string;
  testId: string;
  value: string;
  type?: 'text' | 'search' | 'password';
  required?: boolean;
  /** Characters. */
  maxLength?: number;
  placeholder?: string;
  /** What a browser may fill in. */
  autocomplete?: 'off' | 'new-password' | 'current-password';
  /** No word of a language: neither corrected nor begun with a capital letter. */
  verbatim?: boolean;
  /** Id of what explains it. */
  describedBy?: string;
  onInput: (value: string) => void;
}

/** A line to be typed into, in a form. */
export function TextLine({ label, testId, type = 'text', verbatim, describedBy, onInput, ...rest }: TextLineParts) {
  // Preact tells the kinds of input apart by their roles, which none of these has.
  const kind = { type } as { type: 'text' };
  const asTyped = verbatim === true ? ({ autocapitalize: 'none', spellcheck: false } as const) : {};
  return (
    <label>
      {label}
      <input
        {...rest}
        {...asTyped}
        {...kind}
        aria-describedby={describedBy}
        data-testid={testId}
        onInput={(event) => onInput(event.currentTarget.value)}
      />
    </label>
  );
}

interface CountParts {
  label: string;
  testId: string;
  value: number;
  min: number;
  max: number;
  onChange: (value: number) => void;
}

/** A whole number, in a form. */
export function Count({ label, testId, onChange, ...rest }: CountParts) {
  return (
    <label>
      {label}
      <input
        type="number"
        required
        {...rest}
        data-testid={testId}
        onChange={(event) => onChange(event.currentTarget.valueAsNumber)}
      />
    </label>
  );
}

interface CheckParts {
  label: string;
  testId: string;
  checked: boolean;
  onChange: (checked: boolean) => void;
}

/** A yes or no, in a form. */
export function Check({ label, testId, checked, onChange }: CheckParts) {
  return (
    <label class="check">
      <input
        type="checkbox"
        data-testid={testId}
        checked={checked}
        onChange={(event) => onChange(event.currentTarget.checked)}
      />
      {label}
    </label>
  );
}
