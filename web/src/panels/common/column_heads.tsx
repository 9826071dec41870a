interface Parts {
  names: readonly string[];
  /** From this column on there are numbers. */
  numbersFrom?: number;
}

/** The names of a table's columns. */
export function ColumnHeads({ names, numbersFrom = Infinity }: Parts) {
  return (
    <thead>
      <tr>
        {names.map((name, i) => (
          <th key={name} scope="col" class={i < numbersFrom ? '' : 'number'}>
            {name}
          </th>
        ))}
      </tr>
    </thead>
  );
}
