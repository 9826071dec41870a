import type { IncomingMessage, ServerResponse } from 'node:http';

import { FakeCase } from './case';
import { type Axis, sliceOf } from './ct';

const pieceMax = 1 << 20;
const stepMs = 60;
const steps = ['reading', 'sorting', 'writing'];

interface FakeUpload {
  id: string;
  name: string;
  bytes: number;
  received: number;
}

interface FakeJob {
  id: string;
  kind: string;
  case_id: string;
  state: string;
  share: number;
  step: string;
  problem: object | null;
}

class Refusal extends Error {
  constructor(
    readonly status: number,
    message: string,
  ) {
    super(message);
  }
}

type Body = Record<string, unknown>;
type Answer = { status: number; body?: object; bytes?: Uint8Array; type?: string };
const ok = (body: object, status = 200): Answer => ({ status, body });

/** Uploads, jobs and cases as the server has them, over one made-up CT. */
export class FakeCaseServer {
  readonly cases = new Map<string, FakeCase>();
  private readonly uploads = new Map<string, FakeUpload>();
  private readonly jobs: FakeJob[] = [];
  private made = 0;

  /** False when the path is none of its own. */
  answer(request: IncomingMessage, response: ServerResponse): boolean {
    const url = new URL(request.url ?? '/', 'http://localhost');
    const [, path] = /^\/api\/v1\/((?:uploads|jobs|cases|reamers)(?:\/.*)?)$/.exec(url.pathname) ?? [];
    if (path === undefined) return false;
    void this.call(request, path.split('/'), url.searchParams).then(
      (answer) => send(response, answer),
      (error: unknown) => {
        const status = error instanceof Refusal ? error.status : 500;
        const detail = error instanceof Error ? error.message : String(error);
        send(response, { status, body: { type: 'about:blank', title: 'Refused', status, detail } });
      },
    );
    return true;
  }

  private async call(request: IncomingMessage, path: string[], query: URLSearchParams): Promise<Answer> {
    const bytes = await readAll(request);
    const isJson = request.headers['content-type'] === 'application/json';
    const body = isJson && bytes.length > 0 ? (JSON.parse(bytes.toString()) as Body) : {};
    const [room, id = ''] = path;
    const method = request.method ?? 'GET';
    if (room === 'uploads') return this.upload(method, id, body, bytes, Number(query.get('offset')));
    if (room === 'jobs') return this.job(method, id, query.get('case_id'));
    if (room === 'reamers') return ok({ reamers });
    if (id === '') return method === 'GET' ? this.list() : this.create(body);
    return this.oneCase(`${method} ${path.slice(2, 4).join('/')}`, this.find(id), path, body, query);
  }

  private upload(method: string, id: string, body: Body, bytes: Buffer, offset: number): Answer {
    if (method === 'POST') {
      const { name, bytes: size } = body as { name: string; bytes: number };
      const upload = { id: `u${++this.made}`, name, bytes: size, received: 0 };
      this.uploads.set(upload.id, upload);
      return ok(upload, 201);
    }
    const upload = this.uploads.get(id);
    if (upload === undefined) throw new Refusal(404, `no upload '${id}'`);
    if (method === 'PUT') {
      if (bytes.length > pieceMax) throw new Refusal(413, 'a piece is at most 1 MiB');
      if (offset !== upload.received) throw new Refusal(409, `the next piece begins at ${upload.received}`);
      upload.received += bytes.length;
    }
    if (method === 'DELETE') this.uploads.delete(id);
    return method === 'DELETE' ? { status: 204 } : ok(upload);
  }

  private job(method: string, id: string, caseId: string | null): Answer {
    if (id === '')
      return ok(
        pageOf(
          'jobs',
          this.jobs.filter((job) => caseId === null || job.case_id === caseId),
        ),
      );
    const job = this.jobs.find((one) => one.id === id);
    if (job === undefined) throw new Refusal(404, `no job '${id}'`);
    if (method === 'DELETE' && job.state === 'running') job.state = 'cancelled';
    return ok(job, method === 'DELETE' ? 202 : 200);
  }

  private list(): Answer {
    return ok(
      pageOf(
        'cases',
        [...this.cases.values()].map((one) => one.summary()),
      ),
    );
  }

  private create(body: Body): Answer {
    const { upload_id, side, name = '' } = body as { upload_id: string; side: string; name?: string };
    const upload = this.uploads.get(upload_id);
    if (upload === undefined) throw new Refusal(404, `no upload '${upload_id}'`);
    if (upload.received < upload.bytes) throw new Refusal(409, 'the upload is not complete');
    const id = `case-${++this.made}`;
    const broken = upload.name.includes('broken');
    return ok(
      this.begin('import', id, () => {
        if (broken) throw new Error(`${upload.name}: no image could be read; is it a ZIP of DICOM files?`);
        this.cases.set(id, new FakeCase(id, name === '' ? upload.name : name, side));
      }),
      202,
    );
  }

  private oneCase(call: string, one: FakeCase, path: string[], body: Body, query: URLSearchParams): Answer {
    switch (call) {
      case 'GET ':
        return ok(one.describe());
      case 'DELETE ':
        this.cases.delete(one.id);
        return { status: 204 };
      case 'GET volume/slices':
        return slice(one, path[4] as Axis, Number(path[5]), query.get('of') ?? 'hu');
      case 'GET mesh': {
        const bytes = one.mesh();
        if (bytes === null) throw new Refusal(409, 'the case is not segmented yet');
        return { status: 200, bytes, type: 'application/ply' };
      }
      case 'POST segmentation':
        return ok(
          this.begin('segmentation', one.id, () => one.segment(body)),
          202,
        );
      case 'POST segmentation/undo':
        one.undo();
        return ok(one.describe());
      case 'PUT landmarks':
        one.landmarks = body;
        return ok(one.describe());
      case 'GET measures':
        return ok(one.measures());
      case 'POST plan/proposal':
        return ok(one.propose(body));
      case 'POST plan/assessment':
        return ok({ assessment: one.assess(body), outcome: one.outcome(body) });
      case 'PUT plan': {
        const assessment = one.assess(body);
        if (assessment.needs_override)
          throw new Refusal(409, `${assessment.correction_deg.toFixed(1)}° of correction need an override`);
        one.plan = body;
        return ok({ plan: body, assessment });
      }
      case 'POST build':
        return ok(
          this.begin('build', one.id, () => one.build(body as unknown as Parameters<FakeCase['build']>[0])),
          202,
        );
      default:
        throw new Refusal(405, `${call} is not known`);
    }
  }

  private find(id: string): FakeCase {
    const one = this.cases.get(id);
    if (one === undefined) throw new Refusal(404, `no case '${id}'; GET /api/v1/cases lists them`);
    return one;
  }

  /** A job that takes a moment and then does its deed. */
  private begin(kind: string, case_id: string, action: () => void): FakeJob {
    const first = steps[0] ?? '';
    const job: FakeJob = {
      id: `j${++this.made}`,
      kind,
      case_id,
      state: 'running',
      share: 0,
      step: first,
      problem: null,
    };
    this.jobs.unshift(job);
    const timer = setInterval(() => {
      if (job.state !== 'running') return clearInterval(timer);
      job.share = Math.min(job.share + 0.1, 1);
      job.step = steps[Math.floor(job.share * (steps.length - 0.01))] ?? '';
      if (job.share < 0.999) return;
      clearInterval(timer);
      try {
        action();
        job.state = 'done';
      } catch (error) {
        job.state = 'failed';
        job.problem = { status: 422, title: 'Unprocessable', detail: error instanceof Error ? error.message : '' };
      }
    }, stepMs);
    return job;
  }
}

function slice(one: FakeCase, axis: Axis, index: number, of: string): Answer {
  const volume = of === 'labels' ? one.labels : one.ct.hu;
  if (volume === null) throw new Refusal(409, 'the case is not segmented yet');
  const values = sliceOf(volume, axis, index);
  return { status: 200, bytes: new Uint8Array(values.buffer), type: 'application/octet-stream' };
}

const reamers = [
  {
    ...{ name: 'thesis', words: 'ellipse 18.25,9', diameter_mm: 36.5, radius_mm: 37, cannulated: false },
    nipple: { radius_mm: 3, height_mm: 8 },
    description: 'The reamer of the thesis',
  },
  {
    ...{ name: 'convex-30', words: 'sphere 30', diameter_mm: 32, radius_mm: 30, cannulated: true },
    nipple: null,
    description: 'A cannulated one',
  },
];

async function readAll(request: IncomingMessage): Promise<Buffer> {
  const chunks: Buffer[] = [];
  for await (const chunk of request) chunks.push(chunk as Buffer);
  return Buffer.concat(chunks);
}

function send(response: ServerResponse, { status, body, bytes, type }: Answer): void {
  const json = status >= 400 ? 'application/problem+json' : 'application/json';
  response.writeHead(status, { 'content-type': type ?? json });
  response.end(bytes ?? (body === undefined ? undefined : JSON.stringify(body)));
}

/** All there is on one page. */
const pageOf = (name: string, all: unknown[]) => ({ [name]: all, next: null, total: all.length });
