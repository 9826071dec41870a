// Before all tests: the program makes its demo case once, for the servers of all of them.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { keptDemoVariable, program } from './server_process';

/** A hand that touches nothing, for a moment. */
const script = {
  device: 'hand',
  duration_s: 0.01,
  hand: { start_mm: [0, 0, -40], force_profile: [{ t_s: 0, force_n: 0 }] },
};

/** Returns what is to be done after all tests. */
export default function keepDemo(): () => void {
  const folder = mkdtempSync(join(tmpdir(), 'ream-e2e-demo-'));
  writeFileSync(join(folder, 'script.json'), JSON.stringify(script));
  const data = join(folder, 'data');
  const args = [
    '--case',
    'demo',
    '--script',
    join(folder, 'script.json'),
    '--out',
    join(folder, 'run'),
    '--data',
    data,
  ];
  const { status, stderr } = spawnSync(program, ['simulate', ...args], { encoding: 'utf8' });
  if (status !== 0) throw new Error(`${program} simulate ended with ${String(status)}: ${stderr}`);
  process.env[keptDemoVariable] = data;
  return () => {
    rmSync(folder, { recursive: true, force: true });
  };
}
