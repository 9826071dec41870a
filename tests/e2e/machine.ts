// Machines of a story: an operator types the lines of a paper there as they stand.
import { type ChildProcess, spawn, spawnSync } from 'node:child_process';
import { copyFileSync, cpSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, dirname, join } from 'node:path';

import { end, firstLine, keptDemoVariable, program } from './server_process';
import { watchEachTest, Windows } from './server_for_each_test';

/** A folder that stands for a machine with `ream` installed: its own home, settings, data and server. */
export class Machine {
  /** What the papers call DIR. */
  readonly data: string;
  private readonly home = mkdtempSync(join(tmpdir(), 'ream-machine-'));
  private server: ChildProcess | null = null;

  constructor() {
    this.data = join(this.home, 'data');
    // Settings leave the lines of the paper as they are where several machines are one.
    const settings = `data = ${JSON.stringify(this.data)}\n[serve]\nport = 0\nbackend = "cpu"\n`;
    writeFileSync(join(this.home, 'ream.toml'), settings);
  }

  /** What a server would make at its first start, which takes seconds. */
  putDemo(): void {
    const kept = process.env[keptDemoVariable];
    if (kept !== undefined) cpSync(join(kept, 'cases'), join(this.data, 'cases'), { recursive: true });
  }

  /** What a line prints; throws with its error when it fails. */
  type(line: string, input = ''): string {
    const { status, stdout, stderr } = spawnSync('bash', ['-c', line], { ...this.surroundings(), input });
    if (status !== 0) throw new Error(`${line} ended with ${String(status)}: ${stderr}`);
    return stdout;
  }

  /** Where the server says that it is. */
  async serve(line: string): Promise<string> {
    // Without a shell between, so that it can be ended.
    this.server = spawn('bash', ['-c', `exec ${line}`], {
      ...this.surroundings(),
      stdio: ['ignore', 'pipe', 'inherit'],
    });
    const said = await firstLine(this.server);
    const url = /https?:\S+/.exec(said)?.[0];
    if (url === undefined) throw new Error(`the server names no address: ${said}`);
    return url;
  }

  /** Ctrl-C. */
  async stop(): Promise<number | null> {
    const server = this.server;
    await end(server, 'SIGINT');
    return server?.exitCode ?? null;
  }

  copyTo(other: Machine, file: string): void {
    copyFileSync(join(this.home, file), join(other.home, basename(file)));
  }

  async dispose(): Promise<void> {
    await end(this.server, 'SIGKILL');
    rmSync(this.home, { recursive: true, force: true });
  }

  private surroundings() {
    const env = {
      ...process.env,
      REAM_DATA: undefined,
      REAM_DB: undefined,
      REAM_CONFIG: join(this.home, 'ream.toml'),
      PATH: `${dirname(program)}:${process.env.PATH ?? ''}`,
      HOME: this.home,
    };
    return { cwd: this.home, env, encoding: 'utf8' as const };
  }
}

class Machines extends Windows {
  private readonly all: Machine[] = [];

  add(): Machine {
    const machine = new Machine();
    this.all.push(machine);
    return machine;
  }

  async dispose(): Promise<void> {
    for (const machine of this.all.splice(0)) await machine.dispose();
  }
}

/** To be called once in a file of tests that start their servers themselves. */
export function machinesForEachTest(): Machines {
  const here = new Machines();
  watchEachTest(
    here,
    () => Promise.resolve(),
    () => here.dispose(),
  );
  return here;
}
