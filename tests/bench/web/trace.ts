/** An event of Chromium's trace; times us. */
export interface TraceEvent {
  name: string;
  /** X: with a duration. */
  ph: string;
  pid: number;
  tid: number;
  ts: number;
  dur?: number;
  /** Of the thread's own clock, which stands while the thread waits. */
  tdur?: number;
  args?: { data?: { url?: string }; name?: string };
}

export interface FrameScript {
  computedMs: number;
  passedMs: number;
  /** Computed without letting the browser draw in between. */
  unbrokenMs: number;
}

const scriptNames = new Set([
  'FunctionCall',
  'EvaluateScript',
  'v8.callFunction',
  'RunMicrotasks',
  'MinorGC',
  'MajorGC',
]);

/** Script of the main thread of the page at a URL, summed from the end of each animation frame to the next. */
export function scriptOfFrames(events: readonly TraceEvent[], url: string): FrameScript[] {
  const thread = mainThreadOf(events, url);
  const ours = events.filter((event) => event.tid === thread.tid && event.pid === thread.pid);
  const ends = ours.filter((event) => event.name === 'AnimationFrame' && event.ph === 'e').map((event) => event.ts);
  ends.sort((a, b) => a - b);
  if (ends.length < 2) throw new Error("the browser's trace tells of no animation frames");
  const frames = ends.slice(1).map(() => ({ computedMs: 0, passedMs: 0, unbrokenMs: 0 }));
  let next = 0;
  for (const script of outermost(ours.filter((event) => event.ph === 'X' && scriptNames.has(event.name)))) {
    while (next < ends.length && (ends[next] ?? Infinity) <= script.ts) ++next;
    const frame = frames[next - 1];
    if (frame === undefined) continue;
    if (script.tdur === undefined) throw new Error("the browser's trace does not tell the time of threads");
    frame.computedMs += script.tdur / 1000;
    frame.unbrokenMs = Math.max(frame.unbrokenMs, script.tdur / 1000);
    frame.passedMs += (script.dur ?? 0) / 1000;
  }
  return frames;
}

function mainThreadOf(events: readonly TraceEvent[], url: string): { pid: number; tid: number } {
  const mains = events.filter((event) => event.name === 'thread_name' && event.args?.name === 'CrRendererMain');
  const calls = ({ pid, tid }: TraceEvent) =>
    events.filter((event) => event.pid === pid && event.tid === tid && event.args?.data?.url?.startsWith(url)).length;
  const [page] = mains.map((main) => ({ main, calls: calls(main) })).sort((a, b) => b.calls - a.calls);
  if (page === undefined || page.calls === 0) throw new Error('the page is not in the trace');
  return page.main;
}

/** Those that are in no other, by time. */
function outermost(events: TraceEvent[]): TraceEvent[] {
  const sorted = [...events].sort((a, b) => a.ts - b.ts || (b.dur ?? 0) - (a.dur ?? 0));
  let endUs = -Infinity;
  return sorted.filter((event) => {
    if (event.ts < endUs) return false;
    endUs = event.ts + (event.dur ?? 0);
    return true;
  });
}
