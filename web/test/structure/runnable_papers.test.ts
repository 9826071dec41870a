// Lines of papers that readers copy are run, with the built program, in a folder of their own.
import { spawn } from 'node:child_process';
import { copyFileSync, existsSync, mkdirSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';

import { afterEach, beforeEach, describe, expect, it } from 'vitest';

import { readPaper, repository, runnableBlocks } from './papers';

const given = process.env.REAM_BIN;
const program = given === undefined ? '' : resolve(given);
const papers = ['docs/scripting.md', 'docs/api.md'];

/** A port that nobody listens on. */
const freePort = () =>
  new Promise<number>((found) => {
    const server = createServer().listen(0, '127.0.0.1', () => {
      const address = server.address();
      server.close(() => found(typeof address === 'object' && address !== null ? address.port : 0));
    });
  });

/** All blocks as one script, which says on failure where it stopped and leaves no process behind. */
const scriptOf = (blocks: readonly string[], port: number) =>
  [
    'set -euo pipefail',
    "trap 'status=$?; kill $(jobs -p) 2>&- || true; wait; exit $status' EXIT",
    ...blocks.map(
      (block, i) =>
        `echo "== block ${i + 1}"\n${block.replaceAll(':8080', `:${port}`).replaceAll('--port 8080', `--port ${port}`)}`,
    ),
    'echo "== the end"',
  ].join('\n');

/** What bash says and how it ends, with the program of this build first in its path. */
function run(script: string, folder: string): Promise<{ status: number | null; said: string }> {
  writeFileSync(join(folder, 'blocks.sh'), script);
  const child = spawn('bash', ['blocks.sh'], {
    cwd: folder,
    env: { PATH: `${dirname(program)}:${process.env.PATH ?? ''}`, HOME: folder },
    stdio: ['ignore', 'pipe', 'pipe'],
  });
  let said = '';
  for (const stream of [child.stdout, child.stderr]) stream.on('data', (text: Buffer) => (said += text.toString()));
  return new Promise((ended) => child.once('close', (status) => ended({ status, said })));
}

function copyExamples(folder: string): void {
  const scripts = join(repository, 'examples/scripts');
  mkdirSync(join(folder, 'examples/scripts'), { recursive: true });
  for (const name of readdirSync(scripts)) copyFileSync(join(scripts, name), join(folder, 'examples/scripts', name));
}

describe('Papers that are run', () => {
  let folder = '';
  beforeEach(() => (folder = mkdtempSync(join(tmpdir(), 'ream-papers-'))));
  afterEach(() => rmSync(folder, { recursive: true, force: true }));

  it.each(papers)('%s has blocks to run', (name) => expect(runnableBlocks(readPaper(name)).length).toBeGreaterThan(5));

  const runs = it.skipIf(given === undefined);
  const why = given === undefined ? ' (skipped: REAM_BIN names no program)' : '';
  runs.each(papers)(`%s${why}`, { timeout: 600_000 }, async (name) => {
    expect(existsSync(program), `${program} (REAM_BIN) is there`).toBe(true);
    copyExamples(folder);
    const { status, said } = await run(scriptOf(runnableBlocks(readPaper(name)), await freePort()), folder);
    expect(status, said).toBe(0);
    expect(said).toContain('== the end');
  });
});
