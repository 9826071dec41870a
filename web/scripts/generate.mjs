// Writes src/wire/generated from proto/stream.fbs with flatc, only when the schema is newer than what is there.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, rmSync, statSync } from 'node:fs';
import { dirname, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const webFolder = resolve(dirname(fileURLToPath(import.meta.url)), '..');
const schema = resolve(webFolder, '../proto/stream.fbs');
const target = resolve(webFolder, 'src/wire/generated');
const index = resolve(target, 'stream_generated.ts');

if (!existsSync(index) || statSync(index).mtimeMs < statSync(schema).mtimeMs) {
  rmSync(target, { recursive: true, force: true });
  mkdirSync(target, { recursive: true });
  try {
    execFileSync(process.env.FLATC ?? 'flatc', ['--ts', '-o', target, schema], { stdio: 'inherit' });
  } catch (error) {
    rmSync(target, { recursive: true, force: true });
    console.error(`cannot generate ${target}: ${error.message}; flatc comes with the package flatbuffers-compiler`);
    process.exit(1);
  }
}
