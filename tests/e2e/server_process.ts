import { type ChildProcess, spawn, spawnSync } from 'node:child_process';
import { cpSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { createInterface } from 'node:readline';

/** The program under test: REAM_BIN, else build/ream. */
export const program = resolve(process.env.REAM_BIN ?? join(process.cwd(), '../build/ream'));

/** An account; everybody's password is passwordOf(name). */
export interface TestUser {
  name: string;
  role: 'operator' | 'instructor' | 'trainee';
  displayName: string;
}

/** Names the folder with the demo case that all servers begin with (kept_demo.ts). */
export const keptDemoVariable = 'REAM_KEPT_DEMO';

export const passwordOf = (name: string) => `password of ${name}`;

/** The first line that a program of ours prints: a server's says where it is. */
export function firstLine(child: ChildProcess): Promise<string> {
  return new Promise((found, failed) => {
    if (child.stdout === null) throw new Error('its output goes elsewhere');
    child.once('error', failed);
    child.once('exit', (status) => failed(new Error(`${program} ended with ${String(status)} before it served`)));
    createInterface({ input: child.stdout }).once('line', found);
  });
}

/** Until it is gone. */
export async function end(child: ChildProcess | null, signal: 'SIGINT' | 'SIGKILL'): Promise<void> {
  if (child === null || child.exitCode !== null || child.signalCode !== null) return;
  const gone = new Promise((resolve) => child.once('exit', resolve));
  child.kill(signal);
  await gone;
}

/** A `ream serve` of its own, with a data folder of its own. */
export class ServerProcess {
  private child: ChildProcess | null = null;
  url = '';

  readonly dataFolder: string;
  /** What computes is not seen on the page, and to try all that there is takes seconds. */
  private readonly backend: 'auto' | 'cpu';

  /** The data folder goes away with it. One of its own has the demo case already: making it takes seconds. */
  constructor(dataFolder?: string) {
    this.dataFolder = dataFolder ?? mkdtempSync(join(tmpdir(), 'ream-e2e-'));
    this.backend = dataFolder === undefined ? 'cpu' : 'auto';
    const kept = process.env[keptDemoVariable];
    if (dataFolder === undefined && kept !== undefined) cpSync(kept, this.dataFolder, { recursive: true });
  }

  /** The first user ends the time in which everybody may do everything. */
  addUser({ name, role, displayName }: TestUser): void {
    const args = ['user', 'add', name, '--role', role, '--display-name', displayName, '--data', this.dataFolder];
    const { status, stderr } = spawnSync(program, args, { input: `${passwordOf(name)}\n`, encoding: 'utf8' });
    if (status !== 0) throw new Error(`${program} user add ended with ${String(status)}: ${stderr}`);
  }

  /** What an operator does at the server's own command line. */
  command(...args: string[]): string {
    const { status, stdout, stderr } = spawnSync(program, [...args, '--data', this.dataFolder], { encoding: 'utf8' });
    if (status !== 0) throw new Error(`${program} ${args.join(' ')} ended with ${String(status)}: ${stderr}`);
    return stdout;
  }

  /** Starts it, on the port it had before where there was one, and waits until it names its URL. */
  async start(): Promise<void> {
    const port = this.url === '' ? '0' : new URL(this.url).port;
    const args = ['serve', '--port', port, '--data', this.dataFolder, '--backend', this.backend, '--json'];
    const child = spawn(program, args, { stdio: ['ignore', 'pipe', 'inherit'] });
    this.child = child;
    this.url = (JSON.parse(await firstLine(child)) as { url: string }).url;
  }

  /** Kills it without a chance to say goodbye. */
  async kill(): Promise<void> {
    const child = this.child;
    this.child = null;
    await end(child, 'SIGKILL');
  }

  async dispose(): Promise<void> {
    await this.kill();
    rmSync(this.dataFolder, { recursive: true, force: true });
  }
}
