// Writes src/wire/generated from the schemas in proto with flatc, only when one is newer than what is there.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const webFolder = resolve(dirname(fileURLToPath(import.meta.url)), '..');
const schemas = ['stream', 'device'].map((name) => ({
  source: resolve(webFolder, `../proto/${name}.fbs`),
  index: resolve(webFolder, `src/wire/generated/${name}_generated.ts`),
}));
const target = resolve(webFolder, 'src/wire/generated');

const outdated = schemas.some(
  ({ index }) => !existsSync(index) || schemas.some(({ source }) => statSync(index).mtimeMs < statSync(source).mtimeMs),
);
if (outdated) {
  rmSync(target, { recursive: true, force: true });
  mkdirSync(target, { recursive: true });
  try {
    const sources = schemas.map(({ source }) => source);
    execFileSync(process.env.FLATC ?? 'flatc', ['--ts', '-o', target, ...sources], { stdio: 'inherit' });
    leaveUnchecked(target);
  } catch (error) {
    rmSync(target, { recursive: true, force: true });
    console.error(`cannot generate ${target}: ${error.message}; flatc comes with the package flatbuffers-compiler`);
    process.exit(1);
  }
}

/** flatc gives a field of flags the default 0, which TypeScript does not take for a value of the enum. */
function leaveUnchecked(folder) {
  for (const name of readdirSync(folder, { recursive: true })) {
    const file = join(folder, name);
    if (name.endsWith('.ts')) writeFileSync(file, `// @ts-nocheck\n${readFileSync(file, 'utf8')}`);
  }
}
