import type { ComponentChildren } from 'preact';

import { sentence } from '../../text/format';

interface SliderParts {
  label: string;
  unit: string;
  value: number;
  low: number;
  high: number;
  step: number;
  testId: string;
  /** A value that is marked on the scale. */
  mark?: number | null;
  onChange: (value: number) => void;
}

/** A slider with a number beside it; both say the same and both can be changed. */
export function SliderField({ label, unit, value, low, high, step, testId, mark, onChange }: SliderParts) {
  const take = (text: string) => {
    const number = Number(text);
    if (text !== '' && Number.isFinite(number)) onChange(Math.min(Math.max(number, low), high));
  };
  const markAt = mark === undefined || mark === null ? null : ((mark - low) / (high - low)) * 100;
  return (
    <div class="field">
      <label for={testId}>{label}</label>
      <NumberBox {...{ label, unit, value, low, high, step, testId: `${testId}-number` }} onChange={onChange} />
      <div class="slider">
        <input
          id={testId}
          type="range"
          data-testid={testId}
          {...{ value, min: low, max: high, step }}
          onInput={(event) => take(event.currentTarget.value)}
        />
        {/* The thumb is 16 px wide and its middle stays within the track. */}
        {markAt !== null && markAt >= 0 && markAt <= 100 && (
          <span
            class="slider-mark"
            style={{ left: `calc(8px + (100% - 16px) * ${markAt / 100})` }}
            aria-hidden="true"
          />
        )}
      </div>
    </div>
  );
}

interface NumberParts {
  label: string;
  unit: string;
  value: number;
  low: number;
  high: number;
  step: number;
  testId: string;
  /** That are shown of the value. */
  decimals?: number;
  onChange: (value: number) => void;
}

/** A number with its unit; what is no number is not taken, what is out of range is brought into it. */
export function NumberBox({ label, unit, value, low, high, step, testId, decimals = 3, onChange }: NumberParts) {
  const text = (number: number) => String(Number(number.toFixed(decimals)));
  return (
    <span class="number-box">
      <input
        type="number"
        aria-label={label}
        data-testid={testId}
        {...{ min: low, max: high, step }}
        value={text(value)}
        onChange={(event) => {
          const number = event.currentTarget.valueAsNumber;
          const taken = Number.isFinite(number) ? Math.min(Math.max(number, low), high) : value;
          event.currentTarget.value = text(taken);
          if (taken !== value) onChange(taken);
        }}
      />
      {unit !== '' && <span class="unit">{unit}</span>}
    </span>
  );
}

export function NumberField(parts: NumberParts) {
  return (
    <div class="field field-row">
      <span class="field-name">{parts.label}</span>
      <NumberBox {...parts} />
    </div>
  );
}

interface CheckParts {
  label: string;
  hint?: string;
  checked: boolean;
  testId: string;
  onChange: (checked: boolean) => void;
}

export function CheckField({ label, hint, checked, testId, onChange }: CheckParts) {
  return (
    <label class="check" title={hint}>
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

interface SelectParts<T extends string> {
  label: string;
  value: T;
  options: readonly (readonly [T, string])[];
  testId: string;
  onChange: (value: T) => void;
}

export function SelectField<T extends string>({ label, value, options, testId, onChange }: SelectParts<T>) {
  return (
    <div class="field field-row">
      <label class="field-name" for={testId}>
        {label}
      </label>
      <select
        id={testId}
        data-testid={testId}
        value={value}
        onChange={(event) => {
          const chosen = options.find(([option]) => option === event.currentTarget.value);
          if (chosen !== undefined) onChange(chosen[0]);
        }}
      >
        {options.map(([option, text]) => (
          <option key={option} value={option}>
            {text}
          </option>
        ))}
      </select>
    </div>
  );
}

/** A short message; the look says how serious it is. What went wrong may come in the server's words. */
export function Message({
  kind,
  testId,
  children,
}: {
  kind: 'soft' | 'warn' | 'bad';
  testId?: string;
  children: ComponentChildren;
}) {
  return (
    <p class={`message message-${kind}`} role={kind === 'bad' ? 'alert' : undefined} data-testid={testId}>
      {kind === 'bad' && typeof children === 'string' ? sentence(children) : children}
    </p>
  );
}
