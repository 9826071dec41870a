import { RestClient } from './rest_client';
import type {
  Benchmark,
  BenchmarkSummary,
  KeptRubric,
  KnownMetric,
  NewBenchmark,
  Rubric,
  RubricSummary,
  Score,
  Session,
} from './rest_types';

/** Calls of the REST interface about what sessions are scored by; `base` is the server's origin. */
export class RubricApi {
  private readonly rest: RestClient;

  constructor(base: string) {
    this.rest = new RestClient(base);
  }

  /** All that a rubric may ask for. */
  async metrics(): Promise<KnownMetric[]> {
    return (await this.rest.json('get', '/api/v1/metrics', {})).metrics;
  }
  async rubrics(): Promise<RubricSummary[]> {
    return (await this.rest.json('get', '/api/v1/rubrics', {})).rubrics;
  }
  rubric(id: string): Promise<KeptRubric> {
    return this.rest.json('get', '/api/v1/rubrics/{id}', { path: { id } });
  }
  create(id: string, rubric: Rubric): Promise<KeptRubric> {
    return this.rest.json('post', '/api/v1/rubrics', { body: { id, rubric } });
  }
  /** Its `version` is the one that was edited. */
  save(id: string, body: Rubric): Promise<KeptRubric> {
    return this.rest.json('put', '/api/v1/rubrics/{id}', { path: { id }, body });
  }
  /** What a session is worth by a rubric that is not saved. */
  preview(session: string, body: Rubric, signal: AbortSignal): Promise<Score> {
    return this.rest.json('post', '/api/v1/sessions/{id}/score/preview', { path: { id: session }, body, signal });
  }
  /** Scores a session by a rubric from now on. */
  score(session: string, rubric: string): Promise<Score> {
    return this.rest.json('post', '/api/v1/sessions/{id}/score', { path: { id: session }, body: { rubric } });
  }

  /** The newest sessions that have ended. */
  async ended(limit: number): Promise<Session[]> {
    const query = { sort: '-created_utc', state: 'finished,stopped', limit } as const;
    return (await this.rest.json('get', '/api/v1/sessions', { query })).sessions;
  }

  async benchmarks(): Promise<BenchmarkSummary[]> {
    return (await this.rest.json('get', '/api/v1/benchmarks', {})).benchmarks;
  }
  benchmark(id: string): Promise<Benchmark> {
    return this.rest.json('get', '/api/v1/benchmarks/{id}', { path: { id } });
  }
  addBenchmark(body: NewBenchmark): Promise<Benchmark> {
    return this.rest.json('post', '/api/v1/benchmarks', { body });
  }
}
