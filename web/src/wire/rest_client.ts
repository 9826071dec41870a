import type { paths } from './generated/openapi';
import { type CallOptions, type Method, request, requestJson } from './rest';

type HttpMethod = Lowercase<Method>;
type PathWith<M extends HttpMethod> = {
  [P in keyof paths]: paths[P] extends Record<M, { responses: unknown }> ? P : never;
}[keyof paths];
type Operation<M extends HttpMethod, P extends keyof paths> = M extends keyof paths[P] ? paths[P][M] : never;

type Json<Response> = Response extends { content: { 'application/json': infer Body } } ? Body : never;
type Answer<Op> = Op extends { responses: infer All } ? Json<All[keyof All & (200 | 201 | 202)]> : never;
type BodyOf<Content> = Content extends { 'application/json': infer Body } ? Body : Uint8Array<ArrayBuffer>;

type InPath<Op> = Op extends { parameters: { path: infer Path } } ? { path: Path } : { path?: undefined };
type InQuery<Op> = Op extends { parameters: { query: infer Query } }
  ? { query: Query }
  : Op extends { parameters: { query?: infer Query } }
    ? { query?: Query }
    : { query?: undefined };
type InBody<Op> = Op extends { requestBody: { content: infer Content } }
  ? { body: BodyOf<Content> }
  : Op extends { requestBody?: { content: infer Content } }
    ? { body?: BodyOf<Content> }
    : { body?: undefined };
type Call<Op> = InPath<Op> & InQuery<Op> & InBody<Op> & Omit<CallOptions, 'body'>;

interface Place {
  path?: Readonly<Record<string, string | number>>;
  query?: Readonly<Record<string, string | number | undefined>>;
}

/** Calls of the REST interface as proto/openapi.yaml has them; `base` is the server's origin. */
export class RestClient {
  constructor(readonly base: string) {}

  /** The answer's JSON; throws as request() does. */
  json<M extends HttpMethod, P extends PathWith<M>>(
    method: M,
    path: P,
    call: Call<Operation<M, P>>,
  ): Promise<Answer<Operation<M, P>>> {
    return requestJson(this.url(path, call), upper(method), call);
  }

  /** An answer that is no JSON, or none. */
  request<M extends HttpMethod, P extends PathWith<M>>(
    method: M,
    path: P,
    call: Call<Operation<M, P>>,
  ): Promise<Response> {
    return request(this.url(path, call), upper(method), call);
  }

  url(path: keyof paths, { path: parts = {}, query = {} }: Place = {}): string {
    const filled = path.replace(/\{(\w+)\}/g, (_all, name: string) => encodeURIComponent(parts[name] ?? ''));
    const parameters = new URLSearchParams();
    for (const [name, value] of Object.entries(query)) if (value !== undefined) parameters.set(name, String(value));
    return this.base + filled + (parameters.size > 0 ? `?${parameters.toString()}` : '');
  }
}

const upper = (method: HttpMethod) => method.toUpperCase() as Method;
