/** Scores as REST describes them. */

export type Outcome = 'pass' | 'fail' | 'undecided' | null;
export type Verdict = 'pass' | 'warn' | 'fail' | null;

/** less: up to pass passes, up to warn warns; more: the other way round; between: from low to pass passes, all else warns. */
export type Band =
  | { better: 'report only' }
  | { better: 'less' | 'more'; pass: number; warn: number }
  | { better: 'between'; low: number; pass: number };

export interface ScoredMetric {
  metric: string;
  name: string;
  value: number | null;
  /** Why there is no value. */
  unsaid: string | null;
  unit: string | null;
  definition: string;
  source: string;
  evidence: 'S' | 'M' | 'E' | 'T';
  confidence: string;
  band: Band;
  verdict: Verdict;
  /** Null where the rubric does not ask for it. */
  points: number | null;
  weight: number | null;
  critical: boolean;
}

export interface Score {
  session: string;
  standing: 'kept' | 'computed' | 'live';
  scored_by: string;
  theatre: boolean;
  force_scale: number;
  points: number | null;
  said_percent: number;
  outcome: Outcome;
  reasons: string[];
  rubric: {
    id: string | null;
    version: number;
    rubric: { name: string; pass_points?: number; remark?: string };
  };
  metrics: ScoredMetric[];
}
