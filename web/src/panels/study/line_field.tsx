import { FaultField } from '../common/fault_field';

interface LineFieldParts {
  label: string;
  id: string;
  fault: string | undefined;
  value: string;
  testId?: string;
  onInput: (value: string) => void;
}

/** A line of text with what is wrong with it. */
export function LineField({ label, id, fault, value, testId, onInput }: LineFieldParts) {
  return (
    <FaultField {...{ label, id, fault }}>
      {(described) => (
        <input
          type="text"
          maxLength={1000}
          {...described}
          data-testid={testId}
          value={value}
          onInput={(event) => onInput(event.currentTarget.value)}
        />
      )}
    </FaultField>
  );
}
