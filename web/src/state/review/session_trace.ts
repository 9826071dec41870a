/** A session from its beginning to its end, at equal steps; of each step the moment itself, not what lies between. */
export interface SessionTrace {
  timesS: number[];
  thrustN: number[];
  spindleOn: boolean[];
}

/** Rows that are asked for at most: more than a timeline has pixels is seen by nobody. */
const rowsWanted = 600;

/** Every so many ticks a row, so that a session of that length has no more rows than are wanted. */
export function traceStride(ticks: number): number {
  return Math.max(1, Math.ceil(ticks / rowsWanted));
}

/** Reads what the page needs of trace.csv; throws an Error that says which column is missing. */
export function readTrace(csv: string): SessionTrace {
  const [heading = '', ...rows] = csv.trim().split(/\r?\n/);
  const columns = heading.split(',');
  const column = (name: string) => {
    const found = columns.indexOf(name);
    if (found < 0) throw new Error(`the trace has no column "${name}"`);
    return found;
  };
  const [time, thrust, spindle] = [column('t_s'), column('thrust_n'), column('spindle_on')];
  const trace: SessionTrace = { timesS: [], thrustN: [], spindleOn: [] };
  for (const row of rows) {
    const cells = row.split(',');
    const [timeS, thrustN] = [Number(cells[time]), Number(cells[thrust])];
    if (!Number.isFinite(timeS) || !Number.isFinite(thrustN)) continue;
    trace.timesS.push(timeS);
    trace.thrustN.push(thrustN);
    trace.spindleOn.push(Number(cells[spindle]) === 1);
  }
  return trace;
}
